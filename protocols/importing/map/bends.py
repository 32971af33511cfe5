"""Sections of a route by its curvature."""

import itertools
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from protocols.course.schema import Section, SectionKind

BEND_PER_M = 0.4
"""From this curvature on, a stretch is a bend, 1/m."""

LEAST_TURN = math.radians(20)
"""Bends that turn less are part of the straight around them, rad."""

SHARP_TURN, SHARP_WITHIN_M = math.radians(60), 1.5
"""A right bend is sharp when it turns so far within so short a way: there the limitation binds.

The corners R1 and R2 of ``lab-office`` turn by 135 degrees within 1.3 m, its soft bends by 45
degrees within 1.2 m.
"""

DOUBLING_BACK, DOUBLING_WITHIN_M = math.radians(160), 1.0
"""A route that turns so far within so short a way goes back where it came from."""


class Bend(NamedTuple):
    """A stretch of a route: where it begins and ends, m, how far it turns, rad, and its kind."""

    start: float
    end: float
    turn: float
    kind: SectionKind


def headings(path: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the direction of each piece of a path, unwrapped, rad."""
    unwrapped: NDArray[np.float64] = np.unwrap(np.arctan2(*np.diff(path, axis=0).T[::-1]))
    return unwrapped


def bends(path: NDArray[np.float64], step: float) -> tuple[Bend, ...]:
    """Return the bends of a path whose points have equal distances.

    Parameters
    ----------
    path
        Shape (n, 2), m.
    step
        Distance between its points, m.
    """
    heading = headings(path)
    curvature = ndimage.uniform_filter1d(np.gradient(heading), 5, mode="nearest") / step
    side = np.where(np.abs(curvature) >= BEND_PER_M, np.sign(curvature), 0.0)
    found = []
    edges = np.flatnonzero(np.diff(side, prepend=0.0, append=0.0))
    for a, b in itertools.pairwise(edges.tolist()):
        turn = float(heading[min(b, len(heading) - 1)] - heading[max(a - 1, 0)])
        if side[a] == 0 or abs(turn) < LEAST_TURN:
            continue
        found.append(Bend(a * step, b * step, turn, _kind(heading[a:b], turn, step)))
    return tuple(found)


def _kind(heading: NDArray[np.float64], turn: float, step: float) -> SectionKind:
    if turn > 0:
        return "left"
    window = max(1, round(SHARP_WITHIN_M / step))
    within = turn if len(heading) <= window else float((heading[window:] - heading[:-window]).min())
    return "sharp_right" if -within >= SHARP_TURN else "soft_right"


def doubling_back(path: NDArray[np.float64], step: float) -> NDArray[np.float64] | None:
    """Return where a path turns back; None when it does not."""
    heading, window = headings(path), round(DOUBLING_WITHIN_M / step)
    if len(heading) <= window:
        return None
    turned = np.abs(heading[window:] - heading[:-window])
    at = int(np.argmax(turned))
    return path[at + window // 2] if turned[at] >= DOUBLING_BACK else None


_NAMES: dict[SectionKind, str] = {
    "sharp_right": "sharp right",
    "soft_right": "soft right",
    "left": "left",
    "straight": "straight",
}


def sections(found: tuple[Bend, ...], length: float) -> tuple[Section, ...]:
    """Return a course's sections: the bends, and straights between them."""
    stretches: list[tuple[SectionKind, float]] = []
    reached = 0.0
    for bend in found:
        if bend.start > reached + 0.05:
            stretches.append(("straight", bend.start))
        stretches.append((bend.kind, bend.end))
        reached = bend.end
    if reached < length - 0.05 or not stretches:
        stretches.append(("straight", length))
    counts: dict[str, int] = {}
    made = []
    for i, (kind, end) in enumerate(stretches):
        counts[kind] = counts.get(kind, 0) + 1
        until = None if i == len(stretches) - 1 else round(end, 3)
        made.append(Section(name=f"{_NAMES[kind]} {counts[kind]}", kind=kind, until=until))
    return tuple(made)
