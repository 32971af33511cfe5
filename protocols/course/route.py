"""A smooth way through a course by arc length: where to go, and how sharply it bends."""

import math
from bisect import bisect_left, bisect_right
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from lad.compiled import compiled
from protocols.course.centreline import Centreline
from protocols.course.chair_search import chair_path
from protocols.course.gates import GateCounter
from protocols.course.occupancy import occupancy
from protocols.course.route_checks import NARROWEST, route_fault
from protocols.course.schema import Course
from protocols.course.search import NoWayError, cheapest_path
from protocols.pose import Pose
from protocols.wheelchair import WIDTH

SPACING = 0.05
"""Distance between a route's points, m."""

SMOOTHING = 0.2
"""Standard deviation of the Gaussian that smooths a path, m."""

RUN_OUT = 1.0
"""How far a route continues straight past the last gate, m."""


class Progress(NamedTuple):
    """A place on a route: arc length in m, and distance from it in m, left positive."""

    arc: float
    offset: float


class Route:
    """A way by arc length.

    Parameters
    ----------
    points
        Shape (n, 2): its points about ``SPACING`` apart, m.
    gate_arcs
        Arc length at which each gate is passed, m.
    """

    def __init__(self, points: NDArray[np.float64], gate_arcs: tuple[float, ...]) -> None:
        self.points = points
        self.gate_arcs = gate_arcs
        steps = np.hypot(*np.diff(points, axis=0).T)
        self.arcs = np.concatenate([[0.0], np.cumsum(steps)])
        self.length = float(self.arcs[-1])
        tangents = np.gradient(points, axis=0)
        self.headings = np.unwrap(np.arctan2(tangents[:, 1], tangents[:, 0]))
        # Looked up one at a time, plain numbers are ten times as fast as arrays.
        self._arcs: list[float] = self.arcs.tolist()
        self._headings: list[float] = self.headings.tolist()
        self._xs: list[float] = points[:, 0].tolist()
        self._ys: list[float] = points[:, 1].tolist()

    def locate(self, pose: Pose, gates_passed: int, near: float | None = None) -> Progress:
        """Return the nearest point of the route between the last gate passed and the next one.

        Parameters
        ----------
        pose
            Where the chair is.
        gates_passed
            How many gates the chair has passed; the answer is never past the next one.
        near
            Arc length a moment ago, m: the answer is then within 1 m of it, unless everything
            there is farther away than 1 m.
        """
        low, high = self._leg(gates_passed)
        if near is not None:
            close = self._nearest(pose, max(low, near - 1.0), min(high, near + 1.0))
            if close is not None and abs(close.offset) < 1.0:
                return close
        found = self._nearest(pose, low, high)
        return found if found is not None else Progress(high, 0.0)

    def point(self, arc: float) -> Pose:
        """Return the point at an arc length, clamped to the ends, and the direction there."""
        i = bisect_right(self._arcs, arc) - 1
        return Pose(
            self._between(self._xs, i, arc),
            self._between(self._ys, i, arc),
            self._between(self._headings, i, arc),
        )

    def turn(self, start: float, end: float) -> float:
        """Return by how much the direction changes between two arc lengths, rad, left positive."""
        return self._heading(end) - self._heading(start)

    def _heading(self, arc: float) -> float:
        return self._between(self._headings, bisect_right(self._arcs, arc) - 1, arc)

    def _between(self, values: list[float], i: int, arc: float) -> float:
        """Interpolate as ``numpy.interp`` does, to the last bit; ``i`` is the point before."""
        if i < 0:
            return values[0]
        if i >= len(values) - 1:
            return values[-1]
        before = self._arcs[i]
        if before == arc:
            return values[i]
        slope = (values[i + 1] - values[i]) / (self._arcs[i + 1] - before)
        return slope * (arc - before) + values[i]

    def _leg(self, gates_passed: int) -> tuple[float, float]:
        ends = (0.0, *self.gate_arcs)
        low = ends[min(gates_passed, len(ends) - 1)]
        high = ends[gates_passed + 1] if gates_passed + 1 < len(ends) else self.length
        return low, high

    def _nearest(self, pose: Pose, low: float, high: float) -> Progress | None:
        first = bisect_left(self._arcs, low - SPACING)
        last = bisect_left(self._arcs, high + SPACING)
        if first >= last:
            return None
        i = _closest(self.points, first, last, pose.x, pose.y)
        dx, dy = pose.x - self._xs[i], pose.y - self._ys[i]
        cos, sin = math.cos(self._headings[i]), math.sin(self._headings[i])
        along, across = dx * cos + dy * sin, dy * cos - dx * sin
        arc = self._arcs[i] + min(max(along, -SPACING), SPACING)
        return Progress(min(max(arc, low), high), math.copysign(math.hypot(dx, dy), across))


@compiled
def _closest(points: Any, first: int, last: int, x: float, y: float) -> Any:
    """Return which of the points from ``first`` to before ``last`` is the nearest."""
    nearest, least = first, np.inf
    for i in range(first, last):
        dx, dy = x - points[i, 0], y - points[i, 1]
        square = dx * dx + dy * dy
        if square < least:
            nearest, least = i, square
    return nearest


@lru_cache(maxsize=16)
def plan_route(course: Course, cell: float = 0.1) -> Route:
    """Plan a way through a course, once for each course.

    It is the shortest way that keeps off obstacles, if the chair can take it: it is wide enough,
    the chair can turn all along, no gate's post is in the way, and the way never turns back on the
    spot. Where the chair cannot take it, another one is looked for nearby, then farther off.

    Parameters
    ----------
    course
        The course.
    cell
        Edge length of the raster's cells, m.

    Raises
    ------
    NoWayError
        When no path leads the chair through all gates.
    """
    raster = occupancy(course, cell)
    faults: list[NoWayError] = []
    for half, reach in ((WIDTH / 2, 1.5), (NARROWEST / 2 - cell * math.sqrt(0.5), 3.0)):
        found: list[NoWayError] = []
        try:
            path = cheapest_path(course, raster, half)
            turning = chair_path(course, raster, path, _first_past(course, path), reach)
            for way in (path, turning):
                route = _shaped(course, way)
                fault = _missed(course) if route is None else route_fault(course, raster, route)
                if route is not None and fault is None:
                    return route
                found += [fault] if fault else []
        except NoWayError as error:
            found.append(error)
        faults.append(found[-1])
    raise faults[0]


def _missed(course: Course) -> NoWayError:
    return NoWayError(course.name, 0, "the way found misses one of the gates")


def _shaped(course: Course, cells: NDArray[np.float64]) -> Route | None:
    """Return a path over cells as a smooth route; None when that misses a gate."""
    path = _run_out(_from_start(course, cells))
    for points in (_smooth(path), _resampled(path)):
        arcs = gate_arcs(course, points)
        if len(arcs) == len(course.gates):
            return Route(points, arcs)
    return None


def _first_past(course: Course, path: NDArray[np.float64]) -> list[int]:
    """Return the index of the first point past each gate."""
    counter, first = GateCounter(course), []
    for i, (a, b) in enumerate(pairwise(path), start=1):
        before = counter.passed
        counter.advance((a[0], a[1]), (b[0], b[1]))
        first += [i] * (counter.passed - before)
    return first


def centreline_route(course: Course) -> Route:
    """Return the course's centreline as a route, with its corners as they are drawn."""
    line = Centreline(course)
    points = _resampled(_run_out(line.points))
    return Route(points, gate_arcs(course, points))


def _run_out(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Continue past the end, in the direction of the last half metre."""
    distances = np.hypot(*(points - points[-1]).T)
    before = points[np.flatnonzero(distances >= min(0.5, distances.max()))[-1]]
    direction = (points[-1] - before) / np.hypot(*(points[-1] - before))
    return np.vstack([points, points[-1] + RUN_OUT * direction])


def _resampled(points: NDArray[np.float64]) -> NDArray[np.float64]:
    steps = np.hypot(*np.diff(points, axis=0).T)
    arcs = np.concatenate([[0.0], np.cumsum(steps)])
    samples = np.linspace(0.0, arcs[-1], math.ceil(arcs[-1] / SPACING) + 1)
    return np.column_stack([np.interp(samples, arcs, points[:, i]) for i in (0, 1)])


def _smooth(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Round off the raster's corners; the ends stay where they are."""
    even = _resampled(points)
    # Mirroring a curve in its end point keeps the end in place.
    width = min(len(even) - 1, math.ceil(4 * SMOOTHING / SPACING))
    before = 2 * even[0] - even[width:0:-1]
    after = 2 * even[-1] - even[-2 : -2 - width : -1]
    padded = np.vstack([before, even, after])
    smooth = ndimage.gaussian_filter1d(padded, SMOOTHING / SPACING, axis=0)
    return _resampled(smooth[width : width + len(even)])


def _from_start(course: Course, cells: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.vstack([[course.start.x, course.start.y], cells[1:]])


def gate_arcs(course: Course, points: NDArray[np.float64]) -> tuple[float, ...]:
    """Return the arc length at which each gate is passed, m; fewer when one is missed."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    starts = np.concatenate([[0.0], np.cumsum(steps)])
    counter, arcs = GateCounter(course), []
    for a, b, start, step in zip(points[:-1], points[1:], starts, steps, strict=False):
        before = counter.passed
        share = counter.advance((a[0], a[1]), (b[0], b[1]))
        arcs += [float(start + (share or 0.0) * step)] * (counter.passed - before)
        if counter.finished:
            break
    return tuple(arcs)
