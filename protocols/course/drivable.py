"""Refuse a course that cannot be driven, and give the reason in one line."""

import itertools
import math
from collections.abc import Iterator

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray
from scipy import ndimage

from protocols import wheelchair
from protocols.course.gates import GateCounter, forward
from protocols.course.obstacles import FloorPlan, floor_plan, obstacle_boxes
from protocols.course.occupancy import Occupancy, occupancy
from protocols.course.schema import Course, Gate, Point
from protocols.files.document import spoken
from protocols.files.errors import InputError
from protocols.files.fault import Fault

NEARBY = 1.0
"""How far from the start the centreline may begin, m."""

END_TOLERANCE = 0.3
"""How far from the last gate the centreline may end, m."""


def check_drivable(course: Course) -> None:
    """Check that a lap can be driven.

    Raises
    ------
    InputError
        With the reason that ``undrivable`` gives.
    """
    fault = undrivable(course)
    if fault is not None:
        raise InputError(f"course {course.name}: {spoken(fault.where)}: {fault.message}")


def undrivable(course: Course) -> Fault | None:
    """Return why a lap cannot be driven, and where in the file; None when it can.

    The start overlaps an obstacle or is far from the centreline, a gate is closed, the centreline
    runs through an obstacle or misses a gate, or no path of the chair's width leads through the
    gates in their order.
    """
    floor = floor_plan(course)
    checks = (_start(course), _closed(course, floor), _centreline(course, floor), _path(course))
    return next(itertools.chain.from_iterable(checks), None)


def footprint(x: float, y: float, heading: float) -> shapely.Polygon:
    """Return the chair's outline with the midpoint of its axle at a pose."""
    side = wheelchair.WIDTH / 2
    chair = shapely.box(-wheelchair.REAR, -side, wheelchair.FRONT, side)
    turned = shapely.affinity.rotate(chair, heading, origin=(0, 0), use_radians=True)
    return shapely.affinity.translate(turned, x, y)


def _start(course: Course) -> Iterator[Fault]:
    start = course.start
    chair = footprint(start.x, start.y, start.heading)
    for box in obstacle_boxes(course):
        if chair.intersects(shapely.Polygon(box.corners())):
            yield Fault(("start",), f"the chair would stand in '{box.name}'")
    distance = math.dist(course.centreline[0], (start.x, start.y))
    if distance > NEARBY:
        message = f"{distance:.2f} m from the centreline's beginning; allowed: {NEARBY:g} m"
        yield Fault(("start",), message)


def _closed(course: Course, floor: FloorPlan) -> Iterator[Fault]:
    for i, gate in enumerate(course.gates):
        line = shapely.LineString([gate.left, gate.right])
        opening = shapely.get_parts(line.difference(floor))
        widest = max((float(shapely.length(piece)) for piece in opening), default=0.0)
        if widest < wheelchair.WIDTH:
            boxes = obstacle_boxes(course)
            across = {b.name for b in boxes if line.intersects(shapely.Polygon(b.corners()))}
            by = f" by {', '.join(sorted(across))}" if across else ""
            yield Fault(
                ("gates", i),
                f"{gate.name} is closed{by}; its widest opening is {widest:.2f} m, the chair "
                f"needs {wheelchair.WIDTH:.2f} m",
            )


def _centreline(course: Course, floor: FloorPlan) -> Iterator[Fault]:
    line = shapely.LineString(course.centreline)
    if line.intersects(floor):
        x, y = shapely.get_coordinates(line.intersection(floor))[0]
        message = f"runs through an obstacle at ({x:.2f}, {y:.2f})"
        yield Fault(("centreline",), message)
    points = [(float(x), float(y)) for x, y in shapely.get_coordinates(line.segmentize(0.05))]
    (ax, ay), (bx, by) = points[-2:]
    # Half a millimetre on, so that a centreline that ends on the gate's line has passed it.
    share = 5e-4 / math.dist((ax, ay), (bx, by))
    points.append((bx + share * (bx - ax), by + share * (by - ay)))
    counter = GateCounter(course)
    for before, after in itertools.pairwise(points):
        counter.advance(before, after)
    if not counter.finished:
        name = course.gates[counter.passed].name
        message = f"does not pass gate {name} in its turn, its left post on the left"
        yield Fault(("centreline",), message)
    last = course.gates[-1]
    rest = shapely.Point(bx, by).distance(shapely.LineString([last.left, last.right]))
    if rest > END_TOLERANCE:
        message = f"ends {rest:.2f} m from the last gate, {last.name}; allowed: {END_TOLERANCE:g} m"
        yield Fault(("centreline",), message)


def _path(course: Course) -> Iterator[Fault]:
    """Look for a way of the chair's width from the start to each gate's rear side in turn."""
    grid = occupancy(course)
    wide = grid.free & (grid.distance >= wheelchair.WIDTH / 2)
    here = [(course.start.x, course.start.y)]
    previous = "the start"
    for i, gate in enumerate(course.gates):
        regions, _ = ndimage.label(wide & ~_drawn(grid, gate), structure=np.ones((3, 3)))
        labels = np.asarray(regions, dtype=np.int64)
        if not _found(grid, labels, here) & _found(grid, labels, _beside(gate, -2 * grid.cell)):
            yield Fault(
                ("gates", i),
                f"{gate.name}: no way of the chair's width ({wheelchair.WIDTH:.2f} m) leads "
                f"there from {previous}",
            )
        here = _beside(gate, 2 * grid.cell)
        previous = f"gate {gate.name}"


def _beside(gate: Gate, ahead: float) -> list[Point]:
    """Points along a gate, 1 cm or less apart, shifted through it (positive) or back."""
    fx, fy = forward(gate)
    n = math.ceil(math.dist(gate.left, gate.right) / 0.01) + 1
    xs = np.linspace(gate.left[0], gate.right[0], n) + ahead * fx
    ys = np.linspace(gate.left[1], gate.right[1], n) + ahead * fy
    return list(zip(xs.tolist(), ys.tolist(), strict=True))


def _drawn(grid: Occupancy, gate: Gate) -> NDArray[np.bool_]:
    """Return the cells of a gate's line, thick enough that no diagonal step crosses it."""
    cells = np.zeros_like(grid.free)
    for ahead in (-grid.cell / 2, 0.0, grid.cell / 2):
        for x, y in _beside(gate, ahead):
            cells[grid.index(x, y)] = True
    return cells


def _found(grid: Occupancy, labels: NDArray[np.int64], points: list[Point]) -> set[int]:
    return {int(labels[grid.index(x, y)]) for x, y in points} - {0}
