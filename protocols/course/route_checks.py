"""Whether the chair can be driven along a route: its width, the posts, the gates' order."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from protocols.course.centreline import Centreline
from protocols.course.gates import crossing
from protocols.course.obstacles import obstacle_boxes
from protocols.course.occupancy import Occupancy
from protocols.course.schema import Course
from protocols.course.search import NoWayError
from protocols.wheelchair import WIDTH

if TYPE_CHECKING:  # a route is checked before it is handed out
    from protocols.course.route import Route

NARROWEST = 0.78
"""Width of the narrowest opening that counts as a way, m. The autonomous driver was measured to
pass one of 0.80 m, short or 4 m long, and not a doorway of 0.75 m: it knows the chair by discs and
a laser scan's distances by cells. People need more (`participants/human/passages.py`)."""

ASIDE = np.arange(-0.15, 0.1501, 0.005)
"""Where beside the route the middle of an opening may be, m."""

CLIPPED = 0.2
"""A gate passed nearer to a post than this may be missed, m."""

BACK = math.radians(115)
"""A route that turns by more than this within ``SHORT`` turns back on the spot."""

SHORT = 0.6
"""The length of a turn on the spot, m."""


def route_fault(course: Course, raster: Occupancy, route: "Route") -> NoWayError | None:
    """Return why the chair cannot be driven along a route; None when it can."""
    return next(
        (
            NoWayError(course.name, gate, f"{course.gates[gate].name}: {reason}")
            for gate, reason in _faults(course, raster, route)
        ),
        None,
    )


def _faults(course: Course, raster: Occupancy, route: "Route") -> Iterator[tuple[int, str]]:
    yield from _narrow(course, raster, route)
    yield from _posts(course, route)
    yield from _turns_back(course, route)
    yield from _too_early(course, route)


def _next_gate(route: "Route", arc: float) -> int:
    return min(int(np.searchsorted(route.gate_arcs, arc)), len(route.gate_arcs) - 1)


def _narrow(course: Course, raster: Occupancy, route: "Route") -> Iterator[tuple[int, str]]:
    """Find where the way to a gate is too narrow."""
    cells = np.array([raster.index(float(x), float(y)) for x, y in route.points])
    coarse = raster.distance[cells[:, 0], cells[:, 1]]
    doubtful = np.flatnonzero(
        (coarse < NARROWEST / 2 + raster.cell) & (route.arcs <= route.gate_arcs[-1])
    )
    if not len(doubtful):
        return
    width = _widths(course, route, doubtful)
    worst = int(np.argmin(width))
    if width[worst] < NARROWEST - 0.01:
        x, y = route.points[doubtful[worst]]
        yield (
            _next_gate(route, float(route.arcs[doubtful[worst]])),
            (
                f"the way there is {width[worst]:.2f} m wide at ({x:.2f}, {y:.2f}); allowed: at "
                f"least {NARROWEST:.2f} m, so that a chair of {WIDTH:.2f} m can be driven through"
            ),
        )


def way_widths(course: Course, route: "Route") -> NDArray[np.float64]:
    """Return how wide the way is at each point of a route, to the last gate, shape (n,), m."""
    return _widths(course, route, np.flatnonzero(route.arcs <= route.gate_arcs[-1]))


def _widths(course: Course, route: "Route", at: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return the room across some of a route's points: twice that of the best place beside each."""
    normal = np.column_stack([-np.sin(route.headings), np.cos(route.headings)])[at]
    across = route.points[at][:, None, :] + ASIDE[None, :, None] * normal[:, None, :]
    widest: NDArray[np.float64] = 2 * clearance(course, across.reshape(-1, 2)).reshape(
        len(at), -1
    ).max(axis=1)
    return widest


def clearance(course: Course, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance from each point to the nearest obstacle, shape (n,), m."""
    nearest = np.full(len(points), np.inf)
    low, high = points.min(axis=0) - 1.0, points.max(axis=0) + 1.0
    for box in obstacle_boxes(course):
        corners = box.corners()
        if (corners.max(axis=0) < low).any() or (corners.min(axis=0) > high).any():
            continue
        cos, sin = math.cos(box.heading), math.sin(box.heading)
        dx, dy = points[:, 0] - box.cx, points[:, 1] - box.cy
        past = np.maximum(np.abs(dx * cos + dy * sin) - box.length / 2, 0.0)
        beside = np.maximum(np.abs(dy * cos - dx * sin) - box.width / 2, 0.0)
        np.minimum(nearest, np.hypot(past, beside), out=nearest)
    return nearest


def _posts(course: Course, route: "Route") -> Iterator[tuple[int, str]]:
    """Find gates that the route passes too near to a post."""
    for i, (gate, arc) in enumerate(zip(course.gates, route.gate_arcs, strict=True)):
        x, y, _ = route.point(arc)
        nearest = min(math.dist((x, y), post) for post in (gate.left, gate.right))
        if nearest < min(CLIPPED, 0.3 * math.dist(gate.left, gate.right)):
            yield i, f"the shortest way clips its post at ({x:.2f}, {y:.2f})"


def _turns_back(course: Course, route: "Route") -> Iterator[tuple[int, str]]:
    """Find where the route reverses on the spot."""
    del course
    ahead = np.searchsorted(route.arcs, route.arcs + SHORT).clip(max=len(route.arcs) - 1)
    turn = np.abs(route.headings[ahead] - route.headings)
    worst = int(np.argmax(turn))
    if turn[worst] > BACK:
        x, y = route.points[(worst + int(ahead[worst])) // 2]
        yield (
            _next_gate(route, float(route.arcs[worst])),
            (
                f"the way there turns back on the spot at ({x:.2f}, {y:.2f}); the chair needs room "
                "to turn round"
            ),
        )


def _too_early(course: Course, route: "Route") -> Iterator[tuple[int, str]]:
    """Find legs that lead through a later gate, where the centreline's do not."""
    intended = _early(course, Centreline(course).points)
    for gate, later in sorted(_early(course, route.points) - intended):
        name = course.gates[later].name
        yield (
            gate,
            (
                f"the shortest way there leads through gate {name}, which comes later; set the "
                "gates so that only one way is left"
            ),
        )


def _early(course: Course, points: NDArray[np.float64]) -> set[tuple[int, int]]:
    """Return which later gates a way passes before which gate."""
    found, passed = set(), 0
    for (ax, ay), (bx, by) in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
        a, b = (ax, ay), (bx, by)
        for later in range(passed, len(course.gates)):
            if crossing(course.gates[later], a, b) is None:
                continue
            if later == passed:
                passed += 1
            else:
                found.add((passed, later))
    return found
