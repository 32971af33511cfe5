"""From a map and a route to a course."""

import itertools
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from protocols.course.drivable import footprint, undrivable
from protocols.course.obstacles import floor_plan
from protocols.course.schema import Course, Furniture, Gate, Point, Start
from protocols.files.document import Document
from protocols.files.errors import InputError
from protocols.importing.map.bends import Bend, bends, doubling_back, sections
from protocols.importing.map.floor import Floor, reachable, walls_of
from protocols.importing.map.path import path_through
from protocols.importing.map.ros_map import RosMap
from protocols.importing.map.route import Route
from protocols.importing.map.walls import Walls, walls_around
from protocols.importing.mapping_file import read_mapping

_CENTRELINE_M = 0.01
"""How far the course's centreline may be from the smooth path, m."""

_APART_M = 0.05
"""Points to pass that are nearer to each other than this are the same, m."""


@dataclass(frozen=True)
class ImportedCourse:
    """A course from a map, and what became of the map.

    Attributes
    ----------
    course
        The course, in the world of the map.
    bends
        Of the route, in order.
    corners
        How many corners the walls had in the map, and have now.
    specks
        How many small obstacles were dropped.
    too_tight
        Where on the centreline the chair's outline touches something, m.
    """

    course: Course
    bends: tuple[Bend, ...]
    corners: tuple[int, int]
    specks: int
    too_tight: tuple[Point, ...]


def import_course(drawn: RosMap, route_path: Path) -> ImportedCourse:
    """Return the course that a route makes of a map.

    Parameters
    ----------
    drawn
        The map.
    route_path
        The route file (``route.Route``).

    Raises
    ------
    InputError
        When the route cannot be driven on this map; names the line of the route file.
    """
    route, document = read_mapping(route_path, Route)
    _check_names(route, document)
    floor = _floor(drawn, route, document)
    places = ((route.start.x, route.start.y), *route.via)
    inside = tuple(drawn.inward(*place) for place in places)
    _check_inside(drawn, route, floor, inside, document)
    path = path_through(floor, inside, route.clearance_m)
    if isinstance(path, int):
        raise _unreached(path, document)
    back = doubling_back(path, _step(path))
    if back is not None:
        x, y = drawn.outward(float(back[0]), float(back[1]))
        message = f"the route doubles back at ({x:.2f}, {y:.2f}); the chair cannot turn on the spot"
        raise _fault(document, ("via",), f"{message} in a lap; allowed: another point or order")
    walls = walls_around(floor, path, route.simplify)
    if walls is None:
        raise _fault(
            document, ("simplify",), "the start is in a wall once walls are simplified; allowed: a "
            "smaller tolerance_m or closing_m",
        )  # fmt: skip
    found = bends(path, _step(path))
    course = _course(drawn, route, path, walls, found)
    fault = undrivable(course)
    if fault is not None:
        raise InputError(f"{route_path}: the course cannot be driven: {fault.message}")
    return ImportedCourse(course, found, walls.corners, floor.specks, _too_tight(course))


def _unreached(number: int, document: Document) -> InputError:
    """Return the fault of a point that the chair does not reach; 0 is the start."""
    if number == 0:
        message = "stands nearer to a wall than half the chair's width; allowed: more room"
        return _fault(document, ("start",), message)
    before = "the start" if number == 1 else f"via {number - 1}"
    message = f"nothing as wide as the chair gets there from {before}"
    return _fault(document, ("via", number - 1), message)


def _step(path: NDArray[np.float64]) -> float:
    """Return the distance between a path's points, m."""
    return float(np.hypot(*np.diff(path, axis=0).T).mean())


def _fault(document: Document, where: tuple[str | int, ...], message: str) -> InputError:
    name = ".".join(map(str, where))
    return InputError(f"{document.source}:{document.line(where)}: {name}: {message}")


def _check_names(route: Route, document: Document) -> None:
    if route.gates is not None and len(route.gates) != len(route.via):
        message = f"{len(route.gates)} names; allowed: {len(route.via)}, one for each via"
        raise _fault(document, ("gates",), message)
    names = [name for name in route.gates or () if name is not None]
    if len(set(names)) != len(names):
        raise _fault(document, ("gates",), "names must differ")
    if route.gates is not None and route.gates[-1] is None:
        raise _fault(document, ("gates",), "the last via needs a name: it is the finish")


def _floor(drawn: RosMap, route: Route, document: Document) -> Floor:
    start = drawn.inward(route.start.x, route.start.y)
    _check_on_map(drawn, (route.start.x, route.start.y), document, ("start",))
    walls, specks = walls_of(drawn, route)
    floor = reachable(walls, drawn.cell, start, specks)
    if floor is None:
        unknown = not _known(drawn, start)
        what = "what the map does not know" if unknown else "a wall"
        raise _fault(document, ("start",), f"stands in {what}; allowed: a free place")
    return floor


def _known(drawn: RosMap, at: Point) -> bool:
    row, column = int(at[1] // drawn.cell), int(at[0] // drawn.cell)
    return bool(drawn.free[row, column] or drawn.occupied[row, column])


def _check_on_map(
    drawn: RosMap, place: Point, document: Document, where: tuple[str | int, ...]
) -> None:
    x, y = drawn.inward(*place)
    width, height = drawn.size
    if not (0 <= x < width and 0 <= y < height):
        corners = ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))
        named = ", ".join("({:.2f}, {:.2f})".format(*drawn.outward(*at)) for at in corners)
        message = f"({place[0]:g}, {place[1]:g}) is not on the map; allowed: between its corners"
        raise _fault(document, where, f"{message} {named}")


def _check_inside(
    drawn: RosMap, route: Route, floor: Floor, inside: tuple[Point, ...], document: Document
) -> None:
    """Refuse points that are in walls, cut off from the start, or where the one before stands."""
    for i, place in enumerate(route.via):
        if math.dist(inside[i], inside[i + 1]) < _APART_M:
            before = "the start" if i == 0 else f"via {i}"
            message = f"({place[0]:g}, {place[1]:g}) is where {before} is; allowed: another place"
            raise _fault(document, ("via", i), message)
        _check_on_map(drawn, place, document, ("via", i))
        index = floor.index(*inside[i + 1])
        if index is None or not floor.free[index]:
            message = f"({place[0]:g}, {place[1]:g}) is in a wall, or cut off from the start"
            raise _fault(document, ("via", i), f"{message}; allowed: a free place")


def _course(
    drawn: RosMap, route: Route, path: NDArray[np.float64], walls: Walls, found: tuple[Bend, ...]
) -> Course:
    line = shapely.LineString(path).simplify(_CENTRELINE_M)
    centreline = _out(drawn, shapely.get_coordinates(line))
    length = sum(math.dist(a, b) for a, b in itertools.pairwise(centreline))
    stretch = length / ((len(path) - 1) * _step(path))  # both are lengths of the same path
    scaled = tuple(bend._replace(start=bend.start * stretch, end=bend.end * stretch)
                   for bend in found)  # fmt: skip
    return Course(
        name=route.name,
        title=route.title or f"Course from the map {drawn.path.stem}",
        description=_description(drawn, route, walls),
        walls=tuple(
            w.model_copy(update={"points": _out(drawn, np.array(w.points))}) for w in walls.walls
        ),
        furniture=tuple(_box_out(drawn, box) for box in walls.furniture),
        start=Start(x=route.start.x, y=route.start.y, heading=route.start.heading),
        gates=_gates(drawn, route, path, walls.floor),
        centreline=centreline,
        sections=sections(scaled, length),
    )


def _description(drawn: RosMap, route: Route, walls: Walls) -> str:
    s = route.simplify
    return (
        f"From the map {drawn.path.name} ({drawn.free.shape[1]} x {drawn.free.shape[0]} cells of "
        f"{drawn.cell:g} m, SHA-256 {drawn.digest}). Unknown counts as {route.unknown}; obstacles "
        f"below {s.specks_m2:g} m2 dropped, gaps below {s.closing_m:g} m closed, walls within "
        f"{s.tolerance_m:g} m of the map's, kept up to {s.reach_m:g} m from the route: "
        f"{walls.corners[0]} corners became {walls.corners[1]}."
    )


def _out(drawn: RosMap, points: NDArray[np.float64]) -> tuple[Point, ...]:
    placed = [drawn.outward(x, y) for x, y in points.tolist()]
    return tuple((round(x, 3), round(y, 3)) for x, y in placed)


def _box_out(drawn: RosMap, box: Furniture) -> Furniture:
    x, y = drawn.outward(box.x, box.y)
    heading = box.heading + drawn.origin[2]
    return box.model_copy(update={"x": round(x, 3), "y": round(y, 3), "heading": round(heading, 4)})


def _gates(
    drawn: RosMap, route: Route, path: NDArray[np.float64], floor: shapely.Polygon
) -> tuple[Gate, ...]:
    """Return a gate across the free floor at each via point, in the direction of the path."""
    names = route.gates or tuple(str(i) for i in range(1, len(route.via) + 1))
    gates = []
    reached = 0
    for i, (name, place) in enumerate(zip(names, route.via, strict=True)):
        last = i == len(route.via) - 1
        distances = np.hypot(*(path[reached:] - np.array(drawn.inward(*place))).T)
        at = len(path) - 1 if last else reached + int(np.argmin(distances))
        reached = at
        if name is None:
            continue
        left, right = _across(path, at, floor, route.widest_gate_m)
        (left_out, right_out) = _out(drawn, np.array([left, right]))
        gates.append(Gate(name=name, left=left_out, right=right_out))
    return tuple(gates)


def _across(
    path: NDArray[np.float64], at: int, floor: shapely.Polygon, widest: float
) -> tuple[Point, Point]:
    """Return the ends of a line across the floor, left and right of a point of the path."""
    a, b = path[max(at - 4, 0)], path[min(at + 4, len(path) - 1)]
    along = (b - a) / np.hypot(*(b - a))
    normal = np.array([-along[1], along[0]])
    middle = path[at]
    line = shapely.LineString([middle + widest * normal, middle - widest * normal])
    pieces = shapely.get_parts(shapely.intersection(line, floor))
    piece = min(pieces, key=lambda part: part.distance(shapely.Point(middle)))
    ends = shapely.get_coordinates(piece)
    sides = (ends - middle) @ normal
    left, right = ends[np.argmax(sides)], ends[np.argmin(sides)]
    return (float(left[0]), float(left[1])), (float(right[0]), float(right[1]))


def _too_tight(course: Course) -> tuple[Point, ...]:
    """Return places on the centreline at which the chair's outline touches something."""
    plan = floor_plan(course)
    shapely.prepare(plan)
    line = shapely.LineString(course.centreline)
    touched: list[Point] = []
    for arc in np.arange(0.0, line.length - 0.1, 0.1):
        (ax, ay), (bx, by) = (line.interpolate(a).coords[0] for a in (arc, arc + 0.1))
        chair = footprint(ax, ay, math.atan2(by - ay, bx - ax))
        near = not touched or math.dist(touched[-1], (ax, ay)) > 1.0
        if near and plan.intersects(chair):
            touched.append((round(ax, 2), round(ay, 2)))
    return tuple(touched)
