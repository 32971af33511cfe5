"""Sweeping an arc promises no more than the exact geometry allows, and not much less."""

import math

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from lad.command import Command
from participants.planning.field import scan_field
from participants.planning.sweep import sweep
from protocols.wheelchair import FRONT, REAR, WIDTH

HORIZON = 2.0
RECTANGLE = shapely.Polygon(
    [(FRONT, WIDTH / 2), (-REAR, WIDTH / 2), (-REAR, -WIDTH / 2), (FRONT, -WIDTH / 2)]
)


def outline(command, t):
    """Return the chair's rectangle after driving at constant velocities."""
    v, w = command
    turn = w * t
    x, y = (v * t, 0.0) if abs(w) < 1e-6 else (v / w * math.sin(turn), v / w * (1 - math.cos(turn)))
    c, s = math.cos(turn), math.sin(turn)
    return shapely.transform(RECTANGLE, lambda p: p @ np.array([[c, s], [-s, c]]) + [x, y])


def exact_time(points, command):
    """Return when the rectangle first meets a point, in steps of 10 ms."""
    obstacles = shapely.MultiPoint(points)
    for t in np.arange(0.0, HORIZON, 0.01):
        if shapely.intersects(outline(command, t), obstacles):
            return t
    return HORIZON


@settings(deadline=None, max_examples=60)
@given(
    points=st.lists(st.tuples(st.floats(0.3, 1.4), st.floats(-1.5, 1.5)), min_size=1, max_size=5),
    v=st.floats(0.0, 0.7),
    w=st.floats(-0.5, 0.5),
)
def test_a_sweep_is_never_longer_than_the_exact_one(points, v, w):
    """From a free pose, the promised time is over before the rectangle meets a return."""
    laser = 0.6
    ranges = np.array([r for r, _ in points])
    bearings = np.array([b for _, b in points])
    returns = np.column_stack([laser + ranges * np.cos(bearings), ranges * np.sin(bearings)])
    command = Command(v, w)
    field = scan_field(ranges, bearings, laser, 4.0)
    start = shapely.distance(outline(command, 0.0), shapely.MultiPoint(returns))
    found = sweep(field, command, HORIZON)
    if start > 0.2:
        assert found.time <= exact_time(returns, command) + 0.011
        after = shapely.distance(outline(command, found.time), shapely.MultiPoint(returns))
        # What it leaves over: the discs' overlap, the field's slack, and the last look's step.
        assert found.time == HORIZON or after < 0.25


def test_a_chair_that_stands_too_close_may_move_away():
    """Right before a wall, backing up is free and going on is not."""
    bearings = np.linspace(-0.5, 0.5, 81)
    field = scan_field(0.06 / np.cos(bearings), bearings, 0.6, 4.0)
    assert sweep(field, Command(-0.2, 0.0), HORIZON).time == HORIZON
    assert sweep(field, Command(0.2, 0.0), HORIZON).time < 0.3


def test_standing_is_always_free():
    """Without velocities nothing can be touched."""
    field = scan_field(np.array([0.2]), np.array([0.0]), 0.6, 4.0)
    assert sweep(field, Command(0.0, 0.0), HORIZON).time == HORIZON
