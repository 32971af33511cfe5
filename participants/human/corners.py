"""Sharp corners on the way, as a person sees them ahead."""

import math
from typing import NamedTuple

import numpy as np

from protocols.course.route import Route

SHARP = math.radians(60)
"""From this turn on a corner is sharp (section IV: soft turns are those below 60 degrees), rad."""

WINDOW = 1.2
"""Length of way within which a corner's turn counts, m."""


class Corner(NamedTuple):
    """A sharp corner: arc lengths of its start and end on the route, m; its turn, left positive."""

    start: float
    end: float
    turn: float


def sharp_corners(route: Route) -> tuple[Corner, ...]:
    """Return the sharp corners of a route in order.

    A corner lasts as long as the direction changes by more than ``SHARP`` within ``WINDOW``
    centred there.
    """
    half = WINDOW / 2
    before = np.interp(route.arcs - half, route.arcs, route.headings)
    after = np.interp(route.arcs + half, route.arcs, route.headings)
    side = np.where(np.abs(after - before) >= SHARP, np.sign(after - before), 0.0)
    change = np.flatnonzero(np.diff(np.concatenate([[0.0], side, [0.0]])))
    corners = []
    for first, last in zip(change[:-1], change[1:] - 1, strict=True):
        if side[first] != 0.0:
            start, end = float(route.arcs[first]), float(route.arcs[last])
            corners.append(Corner(start, end, route.turn(start - half, end + half)))
    return tuple(corners)
