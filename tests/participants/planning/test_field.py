"""The distance field of a scan is a close lower bound of the true distances."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from participants.planning.field import (
    ASIDE,
    BEHIND,
    CELL,
    COLUMNS,
    FAR,
    ROWS,
    SLACK,
    scan_field,
)

CENTRES_X = CELL * np.arange(COLUMNS) - BEHIND
CENTRES_Y = CELL * np.arange(ROWS) - ASIDE


def brute_force(ranges, bearings, laser):
    """Return the distance from each cell's centre to the nearest return inside the field, m."""
    seen = ranges < 4.0
    x = laser + ranges[seen] * np.cos(bearings[seen])
    y = ranges[seen] * np.sin(bearings[seen])
    half = CELL / 2
    inside = (x >= -BEHIND - half) & (x < CENTRES_X[-1] + half)
    inside &= (y >= -ASIDE - half) & (y < ASIDE + half)
    if not inside.any():
        return np.full((ROWS, COLUMNS), np.inf)
    dx = CENTRES_X[None, :, None] - x[inside]
    dy = CENTRES_Y[:, None, None] - y[inside]
    return np.sqrt((dx**2 + dy**2).min(axis=2))


@settings(deadline=None, max_examples=40)
@given(st.lists(st.floats(0.05, 4.5), min_size=1, max_size=60), st.floats(0.0, 0.7))
def test_the_field_is_a_close_lower_bound(ranges, laser):
    """Never more than the true distance from anywhere in a cell, and less by a cell or two."""
    ranges = np.array(ranges)
    bearings = np.linspace(-2.0, 2.0, len(ranges))
    field = scan_field(ranges, bearings, laser, 4.0).whole()
    true = brute_force(ranges, bearings, laser)
    # The query may lie half a cell's diagonal from the centre.
    lower = np.clip(true - SLACK / 2, 0.0, FAR)
    assert (field <= lower + 1e-9).all()
    assert (np.minimum(true, FAR) - field <= 1.5 * SLACK + CELL).all()


def test_what_returned_nothing_is_free():
    """Rays at the longest range, and those that are no numbers, leave the field empty."""
    ranges = np.array([4.0, 5.0, np.nan, np.inf])
    field = scan_field(ranges, np.array([-1.0, 0.0, 0.5, 1.0]), 0.6, 4.0).whole()
    assert (field == FAR).all()
