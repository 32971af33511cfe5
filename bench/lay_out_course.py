"""Lay out a loop like the paper's Fig. 2 from its legs and corner angles, and write the course.

    python bench/lay_out_course.py protocols/courses/lab-office.yaml --picture lab-office.png

The lap starts heading east, turns right at R1, R2 and twice more softly, and ends behind its
start: five legs, of which the third and the last follow from closing the loop. Corners are
rounded; walls run alongside at half the corridor's width, with niches cut into them. Furniture is
placed by arc length and distance from the centreline, so that it moves with the legs.
"""

import argparse
import itertools
import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import shapely
from matplotlib.figure import Figure
from ruamel.yaml import YAML

from protocols.course.centreline import Centreline
from protocols.course.drivable import check_drivable
from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course

LEFT, RIGHT = 1, -1


@dataclass(frozen=True)
class Fitting:
    """A niche or a piece of furniture beside the centreline.

    ``at`` is (corner or leg name, metres from its start); ``clear`` is the distance from the
    centreline to its near side; ``along`` and ``deep`` are its size; ``turn`` twists it.
    """

    name: str
    at: tuple[str, float]
    side: int
    clear: float
    along: float
    deep: float
    height: float = 0.8
    turn: float = 0.0


@dataclass(frozen=True)
class Layout:
    """What a loop is made of; lengths in metres, right turns in degrees."""

    first_leg: float = 3.1
    second_leg: float = 9.0
    fourth_leg: float = 2.2
    finish_behind_start: float = 0.5
    sharp: tuple[float, float] = (135.0, 135.0)
    soft: tuple[float, float] = (45.0, 45.0)
    sharp_radius: float = 0.55
    soft_radius: float = 1.5
    half_width: float = 1.05
    screen_to_path: float = 0.8
    thickness: float = 0.1
    niches: tuple[Fitting, ...] = field(default=())
    furniture: tuple[Fitting, ...] = field(default=())


LAB_OFFICE = Layout(
    niches=(
        Fitting("doorway", ("R1", 0.7), LEFT, 1.0, 1.1, 1.6),
        Fitting("alcove", ("diagonal", 2.1), LEFT, 1.0, 1.4, 0.45),
        Fitting("kitchen", ("return", 1.2), LEFT, 1.0, 1.8, 0.9),
        Fitting("door to the stairs", ("homeward", 0.6), LEFT, 1.0, 1.0, 1.2),
    ),
    furniture=(
        Fitting("start bench", ("outward", 0.9), LEFT, 0.8, 1.2, 0.25, 0.5),
        Fitting("bin", ("outward", 0.35), RIGHT, 0.75, 0.28, 0.28, 0.7),
        Fitting("plant at R1", ("R1", 0.1), LEFT, 0.70, 0.35, 0.35, 1.1, 0.4),
        Fitting("cabinet at R1", ("diagonal", 0.1), LEFT, 0.70, 0.5, 0.35, 1.4),
        Fitting("printer", ("diagonal", 1.0), LEFT, 0.70, 0.6, 0.35, 1.0),
        Fitting("shelf", ("diagonal", 2.6), RIGHT, 0.8, 0.9, 0.25, 1.6),
        Fitting("desk", ("diagonal", 3.6), LEFT, 0.65, 1.4, 0.4),
        Fitting("whiteboard", ("diagonal", 4.2), RIGHT, 0.95, 1.0, 0.1, 1.7),
        Fitting("chair", ("diagonal", 5.0), LEFT, 0.62, 0.42, 0.42, 0.8, 0.5),
        Fitting("cabinets at R2", ("R2", 0.65), LEFT, 0.70, 1.3, 0.3, 1.8, 0.2),
        Fitting("trolley at R2", ("R2", 1.2), LEFT, 0.75, 0.45, 0.6, 0.9, -0.3),
        Fitting("radiator", ("return", 2.1), RIGHT, 0.9, 0.9, 0.15, 0.7),
        Fitting("counter", ("return", 2.5), LEFT, 0.68, 0.8, 0.37, 0.9),
        Fitting("plant", ("soft bend 1", 0.5), LEFT, 0.70, 0.3, 0.3, 1.0, 0.6),
        Fitting("bookcase", ("homeward", 0.6), RIGHT, 0.85, 0.7, 0.2, 1.8),
        Fitting("coat rack", ("homeward", 1.4), LEFT, 0.75, 0.3, 0.25, 1.6),
        Fitting("sofa", ("soft bend 2", 0.6), LEFT, 0.72, 1.0, 0.3, 0.7, 0.1),
    ),
)  # fmt: skip

SECTIONS = (
    ("outward", "straight"), ("R1", "sharp_right"), ("diagonal", "straight"),
    ("R2", "sharp_right"), ("return", "straight"), ("soft bend 1", "soft_right"),
    ("homeward", "straight"), ("soft bend 2", "soft_right"), ("finish", "straight"),
)  # fmt: skip


def vertices(layout: Layout) -> np.ndarray:
    """Return start, the four corners and the end; the third and fifth leg close the loop."""
    turns = np.radians([0.0, *layout.sharp, *layout.soft])
    headings = -np.cumsum(turns)
    ways = np.stack([np.cos(headings), np.sin(headings)], axis=1)
    known = layout.first_leg * ways[0] + layout.second_leg * ways[1] + layout.fourth_leg * ways[3]
    target = np.array([-layout.finish_behind_start, 0.0])
    third, fifth = np.linalg.solve(ways[[2, 4]].T, target - known)
    legs = np.array([layout.first_leg, layout.second_leg, third, layout.fourth_leg, fifth])
    return np.vstack([[0.0, 0.0], np.cumsum(legs[:, None] * ways, axis=0)])


def rounded(layout: Layout) -> tuple[np.ndarray, dict[str, tuple[float, float]]]:
    """Round the corners; return the line and each section's start and end arc."""
    corners = vertices(layout)
    degrees = (*layout.sharp, *layout.soft)
    radii = (*(layout.sharp_radius,) * 2, *(layout.soft_radius,) * 2)
    line = [corners[0]]
    marks = [0.0]
    for i, (turn, radius) in enumerate(zip(np.radians(degrees), radii, strict=True), start=1):
        into = _unit(corners[i] - corners[i - 1])
        begin = corners[i] - radius * math.tan(turn / 2) * into
        centre = begin + radius * np.array([into[1], -into[0]])
        angles = -np.linspace(0.0, turn, math.ceil(turn / math.radians(15)) + 1)
        spoke = begin - centre
        arc = [
            centre + np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]) @ spoke
            for a in angles
        ]
        marks.append(_length([*line, arc[0]]))
        line += arc
        marks.append(_length(line))
    line.append(corners[-1])
    marks.append(_length(line))
    names = (name for name, _ in SECTIONS)
    ends = dict(zip(names, itertools.pairwise(marks), strict=True))
    return np.array(line), ends


def lay_out(layout: Layout, name: str, title: str, description: str) -> dict:
    """Return the course as the plain data of its file."""
    line, ends = rounded(layout)
    draft = {
        "schema": 1, "name": name, "title": title, "description": description,
        "start": {"x": 0.0, "y": 0.0, "heading": 0.0},
        "gates": [], "centreline": _points(line),
        "sections": [
            {"name": n, "kind": kind} | ({"until": _r(ends[n][1])} if n != "finish" else {})
            for n, kind in SECTIONS
        ],
        "walls": [], "furniture": [],
    }  # fmt: skip
    path = Centreline(stub(draft))
    draft["gates"] = _gates(layout, path, ends)
    draft["walls"] = _walls(layout, path, line, ends)
    draft["furniture"] = [place(path, ends, f) for f in layout.furniture]
    return draft


def _walls(layout: Layout, path: Centreline, line: np.ndarray, ends: dict) -> list[dict]:
    half = layout.half_width + layout.thickness / 2
    loop = shapely.Polygon(line)
    free = shapely.LinearRing(line).buffer(half, join_style="mitre", mitre_limit=1.2)
    for niche in layout.niches:
        free = free.union(shapely.Polygon(fitting_corners(path, ends, niche)))
    free = shapely.simplify(free, 0.02)
    core = max(free.interiors, key=lambda ring: shapely.Polygon(ring).area)
    walls = [
        {"name": "outer wall", "closed": True, "points": _points(free.exterior.coords[:-1])},
        {"name": "inner wall", "closed": True, "points": _points(core.coords[:-1])},
    ]
    for corner in ("R1", "R2"):
        x, y, heading = path.point(sum(ends[corner]) / 2)
        inwards = np.array([math.sin(heading), -math.cos(heading)])
        tip = np.array([x, y]) + layout.screen_to_path * inwards
        root = shapely.LineString([tip, tip + 4 * inwards]).intersection(shapely.Polygon(core))
        foot = np.array(root.coords[0]) + 0.1 * inwards
        walls.append({"name": f"screen at {corner}", "points": _points([tip, foot])})
    assert loop.is_valid
    for wall in walls:
        wall["thickness"] = layout.thickness
        wall["height"] = 1.6 if "screen" in wall["name"] else 2.4
    return walls


def _gates(layout: Layout, path: Centreline, ends: dict) -> list[dict]:
    places = {"R1": sum(ends["R1"]) / 2, "R2": sum(ends["R2"]) / 2, "F": path.length}
    gates = []
    for name, arc in places.items():
        x, y, heading = path.point(arc)
        left = np.array([-math.sin(heading), math.cos(heading)])
        inner = layout.half_width if name == "F" else layout.screen_to_path
        gates.append(
            {
                "name": name,
                "left": _points([np.array([x, y]) + layout.half_width * left])[0],
                "right": _points([np.array([x, y]) - inner * left])[0],
            }
        )
    return gates


def _frame(path: Centreline, ends: dict, fitting: Fitting) -> tuple[np.ndarray, float]:
    section, metres = fitting.at
    x, y, heading = path.point(ends[section][0] + metres)
    outwards = fitting.side * np.array([-math.sin(heading), math.cos(heading)])
    return np.array([x, y]) + (fitting.clear + fitting.deep / 2) * outwards, heading


def fitting_corners(path: Centreline, ends: dict, fitting: Fitting) -> np.ndarray:
    """Return a fitting's corners on the floor plan."""
    centre, heading = _frame(path, ends, fitting)
    along = np.array([math.cos(heading), math.sin(heading)]) * fitting.along / 2
    across = np.array([-math.sin(heading), math.cos(heading)]) * fitting.deep / 2
    return np.array(
        [centre + a * along + b * across for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    )


def place(path: Centreline, ends: dict, fitting: Fitting) -> dict:
    """Return a piece of furniture as it stands in a course file."""
    centre, heading = _frame(path, ends, fitting)
    return {
        "name": fitting.name, "x": _r(centre[0]), "y": _r(centre[1]),
        "heading": _r(math.remainder(heading + fitting.turn, math.tau)),
        "length": fitting.along, "width": fitting.deep, "height": fitting.height,
    }  # fmt: skip


def stub(draft: dict) -> Course:
    """Return a course with one wall and one gate, enough to measure along its centreline."""
    placeholder = {"name": "none", "points": [[90.0, 90.0], [91.0, 90.0]]}
    gate = {"name": "F", "left": [90.0, 91.0], "right": [90.0, 90.0]}
    return Course.model_validate({**draft, "walls": [placeholder], "gates": [gate]})


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.hypot(*vector)


def _length(points: list) -> float:
    return float(np.hypot(*np.diff(np.array(points), axis=0).T).sum()) if len(points) > 1 else 0.0


def _r(value: float) -> float:
    return round(float(value), 3) + 0.0


def _points(points: object) -> list[list[float]]:
    return [[_r(x), _r(y)] for x, y in points]


def draw(course: Course, path: Path) -> None:
    """Draw the plan as a PNG."""
    figure = Figure(figsize=(10, 9))
    axes = figure.subplots()
    for box in obstacle_boxes(course):
        axes.fill(*box.corners().T, color="0.35" if box.width == 0.1 else "peru")
    axes.plot(*np.array(course.centreline).T, ".-", lw=0.8)
    for gate in course.gates:
        axes.plot(*np.array([gate.left, gate.right]).T, "r-", lw=1)
        axes.text(*gate.left, gate.name, color="red")
    axes.plot(course.start.x, course.start.y, "g>", ms=10)
    axes.set_aspect("equal")
    axes.grid(lw=0.3)
    figure.savefig(path, dpi=80)


def write(out: Path, layout: Layout = LAB_OFFICE) -> Course:
    """Write a layout as the course lab-office; return the course."""
    data = lay_out(
        layout, "lab-office", "Lab office loop",
        "A loop like Fig. 2 of Soh & Demiris (2013): from S through sharp right turns at R1 and "
        "R2, and back to F through two soft right bends.",
    )  # fmt: skip
    write_yaml(data, out)
    return Course.model_validate(data)


def write_yaml(data: dict, out: Path) -> None:
    """Write a course file."""
    yaml = YAML()
    yaml.default_flow_style = None
    yaml.width = 100
    with out.open("w") as file:
        yaml.dump(data, file)


def main() -> None:
    """Write the course file and, on request, its picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    course = write(arguments.out)
    if arguments.picture:
        draw(course, arguments.picture)
    check_drivable(course)
    print(f"{len(obstacle_boxes(course))} boxes, centreline {Centreline(course).length:.2f} m")


if __name__ == "__main__":
    main()
