"""Refuse a course that cannot be driven, and give the reason in one line."""

import itertools
import math
from collections.abc import Iterator

import shapely
import shapely.affinity

from protocols import wheelchair
from protocols.course.gates import GateCounter
from protocols.course.obstacles import FloorPlan, floor_plan, obstacle_boxes
from protocols.course.occupancy import bounds
from protocols.course.route import plan_route
from protocols.course.schema import Course
from protocols.course.search import NoWayError
from protocols.files.document import spoken
from protocols.files.errors import InputError
from protocols.files.fault import Fault

NEARBY = 1.0
"""How far from the start the centreline may begin, m."""

END_TOLERANCE = 0.3
"""How far from the last gate the centreline may end, m."""


LARGEST = 20_000.0
"""Area that a course may cover, m^2."""

TURNED = math.radians(120)
"""A centreline that turns by more than this from one piece to the next turns back."""


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
    runs through an obstacle, turns back or misses a gate, or there is no way on which the whole
    chair could be driven through the gates in their order.
    """
    floor = floor_plan(course)
    checks = (
        _extent(course),
        _start(course),
        _closed(course, floor),
        _centreline(course, floor),
        _way(course),
    )
    return next(itertools.chain.from_iterable(checks), None)


def footprint(x: float, y: float, heading: float) -> shapely.Polygon:
    """Return the chair's outline with the midpoint of its axle at a pose."""
    side = wheelchair.WIDTH / 2
    chair = shapely.box(-wheelchair.REAR, -side, wheelchair.FRONT, side)
    turned = shapely.affinity.rotate(chair, heading, origin=(0, 0), use_radians=True)
    return shapely.affinity.translate(turned, x, y)


def _extent(course: Course) -> Iterator[Fault]:
    """Refuse what no memory would hold as a raster."""
    low_x, low_y, high_x, high_y = bounds(course)
    width, height = high_x - low_x, high_y - low_y
    if width * height > LARGEST:
        message = (
            f"start, gates and centreline with the floor around them cover {width:.0f} x "
            f"{height:.0f} m; allowed: {LARGEST:,.0f} square metres"
        )
        yield Fault(("centreline",), message)


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
    for i, (a, b, c) in enumerate(zip(*(course.centreline[k:] for k in range(3)), strict=False), 1):
        turn = math.atan2(c[1] - b[1], c[0] - b[0]) - math.atan2(b[1] - a[1], b[0] - a[0])
        if abs(math.remainder(turn, math.tau)) > TURNED:
            degrees = math.degrees(abs(math.remainder(turn, math.tau)))
            message = f"turns back by {degrees:.0f} degrees here; are two points swapped?"
            yield Fault(("centreline", i), message)
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


def _way(course: Course) -> Iterator[Fault]:
    """Plan the way that the drivers are going to take; it leads the whole chair through the gates.

    The plan is kept: who is going to drive uses it.
    """
    try:
        plan_route(course)
    except NoWayError as error:
        yield Fault(("gates", error.gate), error.reason)
