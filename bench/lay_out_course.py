"""Lay out a loop like the paper's Fig. 2 from its legs and corner angles, and write the course.

    python bench/lay_out_course.py protocols/courses/lab-office.yaml --picture lab-office.png

The lap starts heading east, turns right at R1, R2 and twice more softly, and ends behind its
start: five legs, of which the third and the last follow from closing the loop. Corners are
rounded; walls run alongside at half the corridor's width, with niches cut into them. Furniture is
placed by arc length and distance from the centreline, so that it moves with the legs.
"""

import itertools
import math
from dataclasses import dataclass, field

import numpy as np
import shapely
from course_draft import (
    LEFT,
    RIGHT,
    Fitting,
    fitting_corners,
    millimetres,
    place,
    points,
    round_corners,
    stub,
    write_course,
)

from protocols.course.centreline import Centreline


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
    degrees = [-turn for turn in (*layout.sharp, *layout.soft)]
    radii = (*(layout.sharp_radius,) * 2, *(layout.soft_radius,) * 2)
    line, marks = round_corners(vertices(layout), degrees, radii)
    names = (name for name, _ in SECTIONS)
    return line, dict(zip(names, itertools.pairwise([0.0, *marks]), strict=True))


def lay_out(layout: Layout, name: str, title: str, description: str) -> dict:
    """Return the course as the plain data of its file."""
    line, ends = rounded(layout)
    draft = {
        "schema": 1, "name": name, "title": title, "description": description,
        "start": {"x": 0.0, "y": 0.0, "heading": 0.0},
        "gates": [], "centreline": points(line),
        "sections": [
            {"name": n, "kind": kind}
            | ({"until": millimetres(ends[n][1])} if n != "finish" else {})
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
        {"name": "outer wall", "closed": True, "points": points(free.exterior.coords[:-1])},
        {"name": "inner wall", "closed": True, "points": points(core.coords[:-1])},
    ]
    for corner in ("R1", "R2"):
        x, y, heading = path.point(sum(ends[corner]) / 2)
        inwards = np.array([math.sin(heading), -math.cos(heading)])
        tip = np.array([x, y]) + layout.screen_to_path * inwards
        root = shapely.LineString([tip, tip + 4 * inwards]).intersection(shapely.Polygon(core))
        foot = np.array(root.coords[0]) + 0.1 * inwards
        walls.append({"name": f"screen at {corner}", "points": points([tip, foot])})
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
                "left": points([np.array([x, y]) + layout.half_width * left])[0],
                "right": points([np.array([x, y]) - inner * left])[0],
            }
        )
    return gates


def lab_office() -> dict:
    """Return the course lab-office as the plain data of its file."""
    return lay_out(
        LAB_OFFICE, "lab-office", "Lab office loop",
        "A loop like Fig. 2 of Soh & Demiris (2013): from S through sharp right turns at R1 and "
        "R2, and back to F through two soft right bends.",
    )  # fmt: skip


if __name__ == "__main__":
    write_course(lab_office, __doc__.splitlines()[0])
