"""Whether recorded positions are positions on the course, and what they may be otherwise."""

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from protocols.course.gates import GateCounter
from protocols.course.obstacles import floor_plan
from protocols.course.schema import Course

Points = NDArray[np.float64]

MOST_OUTSIDE = 0.05
"""Share of a lap's steps that may lie outside the course or in an obstacle: sensors err."""

_TOLERANCE = 0.1
"""How far into an obstacle, or out of the course, a position may be, m."""

_ONWARDS = 0.5
"""How far beyond a lap's last recorded position its end may be, m."""

_LOOKED_AT = 200
"""Steps that are looked at when a frame is searched for."""

_SCALES = {"": 1.0, "millimetres": 1e-3, "centimetres": 1e-2}
_AXES = {
    "": np.array([[1, 0], [0, 1]]),
    "y mirrored": np.array([[1, 0], [0, -1]]),
    "x mirrored": np.array([[-1, 0], [0, 1]]),
    "x and y exchanged": np.array([[0, 1], [1, 0]]),
    "turned by 180 degrees": np.array([[-1, 0], [0, -1]]),
    "turned by 90 degrees": np.array([[0, -1], [1, 0]]),
    "turned by -90 degrees": np.array([[0, 1], [-1, 0]]),
    "x and y exchanged and mirrored": np.array([[0, -1], [-1, 0]]),
}


class Placement(NamedTuple):
    """Where a lap's positions lie.

    Attributes
    ----------
    on_course
        Whether they are positions on the course, as far as can be seen.
    whole
        Whether a finished lap passes every gate in order, as it must.
    outside
        Share of the known ones outside it or in an obstacle, 0 to 1.
    likely
        What they may be, in words; "" when nothing fits.
    metres
        Whether their distances are metres, as far as is known.
    """

    on_course: bool
    outside: float = 0.0
    likely: str = ""
    metres: bool = True
    whole: bool = True


INCOMPLETE = (
    "the positions do not pass the gates in their order, although the lap was finished: they are a "
    "part of it, or in another frame"
)
"""The remark on a lap whose positions are on the floor, but not all the way."""


class Floor:
    """Where the chair can be on a course."""

    def __init__(self, course: Course) -> None:
        plan = floor_plan(course)
        self._course = course
        self._inside = plan.convex_hull.buffer(_TOLERANCE)
        self._solid = plan.buffer(-_TOLERANCE / 2)
        self._start = np.array([course.start.x, course.start.y])
        shapely.prepare([self._inside, self._solid])

    def placement(self, xy: Points, *, finished: bool) -> Placement:
        """Return whether a lap's positions are on the course.

        Parameters
        ----------
        xy
            Positions of its steps, shape (n, 2), m; NaN where not known.
        finished
            Whether the lap was finished: then it passes every gate in order.
        """
        known = xy[np.isfinite(xy).all(axis=1)]
        if not len(known):
            return Placement(on_course=True)
        outside = self._outside(known)
        whole = not finished or self._passes(known)
        if outside <= MOST_OUTSIDE and whole:
            return Placement(on_course=True, outside=outside)
        likely, metres = self._likely(known, finished=finished)
        if outside <= MOST_OUTSIDE and not likely:  # on the floor, and no other frame fits better
            return Placement(True, outside, whole=False)
        return Placement(False, outside, likely, metres, whole)

    def _outside(self, xy: Points) -> float:
        off = ~shapely.contains_xy(self._inside, xy) | shapely.contains_xy(self._solid, xy)
        return float(off.mean())

    def _passes(self, xy: Points) -> bool:
        """Return whether the way passes every gate; it is extended, as a step is where it began.

        It goes on as over its last half metre: a single step may point anywhere where a sensor errs
        by more than the chair moves.
        """
        gates = GateCounter(self._course)
        back = xy[-1] - xy
        away = np.flatnonzero(np.hypot(*back.T) >= _ONWARDS)
        onwards = back[away[-1]] if len(away) else back[0]
        if onwards.any():
            xy = np.vstack([xy, xy[-1] + _ONWARDS * onwards / np.hypot(*onwards)])
        for before, after in zip(xy[:-1].tolist(), xy[1:].tolist(), strict=True):
            gates.advance(tuple(before), tuple(after))
        return gates.finished

    def _likely(self, known: Points, *, finished: bool) -> tuple[str, bool]:
        """Return the simplest frame in which the positions are on the course, and if in metres."""
        some = known[:: -(-len(known) // _LOOKED_AT)]
        for words, metres, xy in self._frames(some, known[0]):
            if self._outside(xy) <= MOST_OUTSIDE and (not finished or self._passes(xy)):
                return words, metres
        spread = np.ptp(known, axis=0)
        degrees = (np.abs(known) <= np.array([180, 180])).all() and (spread < 0.01).all()
        degrees = degrees and np.abs(known).max() >= 1  # nobody drives at 0 N 0 E: kilometres
        if len(known) > 1 and degrees and (spread > 0).any():
            return "latitude and longitude", False
        return "", False

    def _frames(self, xy: Points, first: Points) -> Iterator[tuple[str, bool, Points]]:
        """Yield other frames, simple ones first: as they are, or moved to the course's start."""
        for moved in (False, True):
            for unit, scale in _SCALES.items():
                for axes, turn in _AXES.items():
                    there = scale * xy @ turn.T
                    shift = self._start - scale * turn @ first if moved else np.zeros(2)
                    if moved and np.hypot(*shift) < _TOLERANCE:  # the same place, as sensors go
                        continue
                    by = f"moved by ({shift[0]:.1f}, {shift[1]:.1f}) m" if moved else ""
                    words = ", ".join(word for word in (unit, axes, by) if word)
                    if words:
                        yield words, scale == 1, there + shift


def said_of(misplaced: Sequence[Placement]) -> Iterator[str]:
    """Say of laps whose positions are not on the course what these may be, once for each guess."""
    by_guess: dict[str, list[Placement]] = {}
    for placement in misplaced:
        by_guess.setdefault(re.sub(r"\(.*?\) m", "", placement.likely), []).append(placement)
    for alike in by_guess.values():
        n, share = len(alike), sum(p.outside for p in alike) / len(alike)
        likely = f"; likely: {alike[0].likely}" if alike[0].likely else ""
        what = f"{100 * share:.0f}% of the steps outside it or in an obstacle"
        if share <= MOST_OUTSIDE:
            what = "its gates are not passed in their order"
        laps = "1 lap" if n == 1 else f"{n} laps"
        yield (
            f"positions of {laps} do not fit the course ({what}{likely}): no map is drawn from them"
            + ("" if alike[0].metres else ", and no distance is computed")
        )
