"""Where along the lap: arc length on the centreline, and the section there."""

import math
from bisect import bisect_right
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled
from protocols.course.schema import Course, SectionKind
from protocols.pose import Pose

REACH = 1.5
"""How far along the lap the chair may have moved since the last projection, m."""


class Stretch(NamedTuple):
    """A section of the course with its place on the centreline.

    Attributes
    ----------
    name, kind
        As in the course file.
    start, end
        Arc lengths, m.
    """

    name: str
    kind: SectionKind
    start: float
    end: float


class Centreline:
    """The centreline of a course by arc length.

    Attributes
    ----------
    points
        Shape (n, 2): its vertices, m.
    arcs
        Shape (n,): their arc lengths, m.
    length
        From start to end, m.
    sections
        In order, without gaps.
    """

    points: NDArray[np.float64]
    arcs: NDArray[np.float64]
    length: float
    sections: tuple[Stretch, ...]

    def __init__(self, course: Course) -> None:
        self.points = np.array(course.centreline, dtype=np.float64)
        steps = np.hypot(*np.diff(self.points, axis=0).T)
        self.arcs = np.concatenate([[0.0], np.cumsum(steps)])
        self.length = float(self.arcs[-1])
        # Looked up one at a time, plain numbers are faster than arrays.
        self._points = [(x, y) for x, y in self.points.tolist()]
        self._arcs: list[float] = self.arcs.tolist()
        ends = [self.length if s.until is None else s.until for s in course.sections]
        starts = [0.0, *ends[:-1]]
        self.sections = tuple(
            Stretch(s.name, s.kind, a, b)
            for s, a, b in zip(course.sections, starts, ends, strict=True)
        )

    def locate(self, x: float, y: float, near: float | None = None) -> tuple[float, float]:
        """Project a point onto the centreline.

        Parameters
        ----------
        x, y
            The point, m.
        near
            Arc length of the projection a moment before, m; the projection then stays within
            ``REACH`` of it, so that it never jumps to a neighbouring leg. None: the nearest of all.

        Returns
        -------
        tuple[float, float]
            Arc length in [0, ``length``], and signed distance from the centreline, left positive.
        """
        low, high = (0.0, self.length) if near is None else (near - REACH, near + REACH)
        arc, offset = _project(self.points, self.arcs, (x, y), (low, high))
        return arc, offset

    def point(self, arc: float) -> Pose:
        """Return the point at an arc length, clamped to the ends, and the direction there."""
        arc = min(max(arc, 0.0), self.length)
        arcs = self._arcs
        i = min(bisect_right(arcs, arc) - 1, len(arcs) - 2)
        (ax, ay), (bx, by) = self._points[i], self._points[i + 1]
        share = (arc - arcs[i]) / (arcs[i + 1] - arcs[i])
        return Pose(ax + share * (bx - ax), ay + share * (by - ay), math.atan2(by - ay, bx - ax))

    def section(self, arc: float) -> Stretch:
        """Return the section an arc length lies in; a boundary belongs to the later one."""
        for section in self.sections[:-1]:
            if arc < section.end:
                return section
        return self.sections[-1]


@compiled
def _project(points: Any, arcs: Any, at: Any, between: Any) -> Any:
    """Nearest point of the polyline between two arc lengths: (arc, signed offset)."""
    x, y = at
    low, high = between
    best = np.inf
    arc = min(max(low, 0.0), arcs[-1])
    side = 0.0
    for i in range(len(arcs) - 1):
        if arcs[i + 1] < low or arcs[i] > high:
            continue
        length = arcs[i + 1] - arcs[i]
        ux = (points[i + 1, 0] - points[i, 0]) / length
        uy = (points[i + 1, 1] - points[i, 1]) / length
        rx, ry = x - points[i, 0], y - points[i, 1]
        along = rx * ux + ry * uy
        along = min(max(along, 0.0, low - arcs[i]), length, high - arcs[i])
        dx, dy = rx - along * ux, ry - along * uy
        distance = math.hypot(dx, dy)
        if distance < best:
            best = distance
            arc = arcs[i] + along
            side = ux * dy - uy * dx
    return arc, math.copysign(best, side)
