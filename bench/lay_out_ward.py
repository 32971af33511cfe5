"""Lay out a hospital corridor with sharp rights, soft bends and left turns, and write the course.

    python bench/lay_out_ward.py protocols/courses/ward-corridor.yaml --picture ward-corridor.png

Another building than the paper's: nothing in it is calibrated. The way is legs and turns; rooms
(open doors, bays, a nurses' station) are cut into the corridor's walls, and furniture is placed by
arc length and distance from the centreline, as for the default course.
"""

import itertools
import math
from dataclasses import dataclass

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
    unit,
    write_course,
)

from protocols.course.centreline import Centreline

HALF_WIDTH = 1.05
"""From the centreline to a wall's face, m."""

THICKNESS = 0.1
SCREEN_TO_PATH = 0.8
"""Screens reach from the inside of a sharp turn this close to the centreline, m, as on the default
course: a chair that cuts the corner would leave the centreline, and with it the section, behind."""

FINISH_LEFT = 1.45
"""From the centreline to the finish's left post, in the open day room, m."""

RUN_IN, RUN_OUT = 1.1, 1.6
"""Floor behind the start and past the finish, m."""


@dataclass(frozen=True)
class Turn:
    """A turn to the left (positive degrees) or right, rounded; and the leg after it."""

    name: str
    kind: str
    degrees: float
    radius: float
    leg: str
    metres: float


FIRST_LEG = ("from the bay", 3.0)
TURNS = (
    Turn("R1", "sharp_right", -105.0, 0.55, "to the lift", 4.0),
    Turn("L1", "left", 105.0, 0.6, "past the lift", 3.6),
    Turn("soft bend 1", "soft_right", -40.0, 1.5, "ramp", 4.6),
    Turn("R2", "sharp_right", -130.0, 0.55, "ward", 6.4),
    Turn("soft bend 2", "soft_right", -30.0, 1.8, "past the kitchen", 2.8),
    Turn("L2", "left", 75.0, 0.8, "to the day room", 2.6),
)

ROOMS = (
    Fitting("bathroom", ("from the bay", 1.5), LEFT, 1.0, 1.2, 1.3),
    Fitting("store", ("to the lift", 0.7), LEFT, 1.0, 1.1, 1.0),
    Fitting("lift", ("past the lift", 1.9), RIGHT, 1.0, 1.2, 0.85),
    Fitting("nurses' station", ("ramp", 1.6), LEFT, 1.0, 2.2, 1.2),
    Fitting("bay 2", ("ward", 1.5), LEFT, 1.0, 2.0, 1.8),
    Fitting("bay 3", ("ward", 4.2), LEFT, 1.0, 1.8, 1.8),
    Fitting("kitchen", ("past the kitchen", 0.5), RIGHT, 1.0, 1.4, 1.1),
    Fitting("day room", ("to the day room", 1.6), LEFT, 1.0, 1.6, 1.6),
)

FURNITURE = (
    Fitting("linen cart", ("from the bay", 0.4), RIGHT, 0.72, 0.6, 0.3, 1.1),
    Fitting("wash basin", ("from the bay", 1.5), LEFT, 1.7, 0.6, 0.4, 0.85),
    Fitting("notice board", ("R1", 0.3), LEFT, 0.85, 0.9, 0.12, 1.7, 0.2),
    Fitting("shelves", ("to the lift", 0.7), LEFT, 1.5, 0.9, 0.35, 1.9),
    Fitting("bench", ("to the lift", 1.2), RIGHT, 0.78, 1.1, 0.27, 0.45),
    Fitting("fire extinguisher", ("L1", 0.2), RIGHT, 0.80, 0.2, 0.2, 0.6),
    Fitting("wheelchair", ("past the lift", 2.4), LEFT, 0.70, 0.8, 0.35, 0.9, 0.1),
    Fitting("drip stand", ("past the lift", 0.7), RIGHT, 0.75, 0.3, 0.3, 1.7),
    Fitting("medicine trolley", ("ramp", 1.0), RIGHT, 0.68, 0.5, 0.37, 1.0),
    Fitting("counter", ("ramp", 1.6), LEFT, 1.15, 1.8, 0.5, 1.1),
    Fitting("pillar", ("R2", 0.4), LEFT, 0.78, 0.35, 0.3, 2.4),
    Fitting("bed 2", ("ward", 1.4), LEFT, 1.3, 0.9, 1.4, 0.9),
    Fitting("locker", ("ward", 2.9), LEFT, 0.72, 0.45, 0.33, 1.2),
    Fitting("bed 3", ("ward", 4.4), LEFT, 1.5, 0.9, 1.2, 0.9),
    Fitting("radiator", ("ward", 3.4), RIGHT, 0.9, 1.4, 0.15, 0.7),
    Fitting("fridge", ("past the kitchen", 0.6), RIGHT, 1.3, 0.6, 0.6, 1.8),
    Fitting("chairs", ("past the kitchen", 0.9), LEFT, 0.75, 1.0, 0.3, 0.8),
    Fitting("plant", ("L2", 0.6), RIGHT, 0.75, 0.3, 0.3, 1.2),
    Fitting("table", ("to the day room", 1.7), LEFT, 1.5, 0.9, 0.7, 0.75),
    Fitting("piano", ("to the day room", 1.3), RIGHT, 0.68, 1.2, 0.37, 1.2),
)


def way() -> tuple[np.ndarray, list[tuple[str, str, float]]]:
    """Return the centreline, its turns rounded, and each section's name, kind and end (m)."""
    degrees, radii = zip(*((turn.degrees, turn.radius) for turn in TURNS), strict=True)
    line, ends = round_corners(_vertices(), degrees, radii)
    named = [(FIRST_LEG[0], "straight")]
    for turn in TURNS:
        named += [(turn.name, turn.kind), (turn.leg, "straight")]
    return line, [(*section, end) for section, end in zip(named, ends, strict=True)]


def lay_out() -> dict:
    """Return the course as the plain data of its file."""
    line, sections = way()
    draft = {
        "schema": 1, "name": "ward-corridor", "title": "Ward corridor",
        "description": "Not the paper's: sharp rights at R1 and R2, soft right bends, and left "
        "turns between them.",
        "start": {"x": 0.0, "y": 0.0, "heading": 0.0},
        "gates": [], "centreline": points(line),
        "sections": [
            {"name": name, "kind": kind}
            | ({"until": millimetres(end)} if name != TURNS[-1].leg else {})
            for name, kind, end in sections
        ],
        "walls": [], "furniture": [],
    }  # fmt: skip
    path = Centreline(stub(draft))
    starts = [0.0, *(end for _, _, end in sections)]
    ends = {s[0]: span for s, span in zip(sections, itertools.pairwise(starts), strict=True)}
    free = _free(path, line, ends)
    draft["walls"] = [*_walls(free), *(_screen(path, ends, free, turn) for turn in _sharp())]
    draft["gates"] = _gates(path, ends, free)
    draft["furniture"] = [place(path, ends, piece) for piece in FURNITURE]
    return draft


def _vertices() -> np.ndarray:
    headings = np.cumsum([0.0, *(math.radians(turn.degrees) for turn in TURNS)])
    legs = np.array([FIRST_LEG[1], *(turn.metres for turn in TURNS)])
    ways = np.stack([np.cos(headings), np.sin(headings)], axis=1)
    return np.vstack([[0.0, 0.0], np.cumsum(legs[:, None] * ways, axis=0)])


def _free(path: Centreline, line: np.ndarray, ends: dict) -> shapely.Polygon:
    """Return the floor up to the walls' middle lines."""
    behind = line[0] - RUN_IN * unit(line[1] - line[0])
    ahead = line[-1] + RUN_OUT * unit(line[-1] - line[-2])
    reach = HALF_WIDTH + THICKNESS / 2
    whole = shapely.LineString([behind, *line, ahead])
    free = whole.buffer(reach, cap_style="flat", join_style="mitre", mitre_limit=1.2)
    for room in ROOMS:
        free = free.union(shapely.Polygon(fitting_corners(path, ends, room)))
    return shapely.simplify(free, 0.02)


def _walls(free: shapely.Polygon) -> list[dict]:
    rings = {"outer wall": free.exterior} | {
        f"core {i}": ring for i, ring in enumerate(free.interiors, start=1)
    }
    return [
        {"name": name, "closed": True, "points": points(ring.coords[:-1]),
         "thickness": THICKNESS, "height": 2.4}
        for name, ring in rings.items()
    ]  # fmt: skip


def _sharp() -> list[Turn]:
    return [turn for turn in TURNS if "soft" not in turn.name]


def _screen(path: Centreline, ends: dict, free: shapely.Polygon, turn: Turn) -> dict:
    """Return a screen from the wall on the inside of a turn towards its middle."""
    at, inwards = _middle(path, ends, turn)
    foot = at + (_to_wall(free, at, inwards) + 0.1) * inwards
    return {
        "name": f"screen at {turn.name}", "points": points([at + SCREEN_TO_PATH * inwards, foot]),
        "thickness": THICKNESS, "height": 1.6,
    }  # fmt: skip


def _gates(path: Centreline, ends: dict, free: shapely.Polygon) -> list[dict]:
    """Return a gate from wall to screen in each sharp turn, and one at the finish."""
    gates = []
    for turn in _sharp():
        at, inwards = _middle(path, ends, turn)
        outer = at - (_to_wall(free, at, -inwards) - THICKNESS / 2) * inwards
        posts = points([outer, at + SCREEN_TO_PATH * inwards])
        left, right = posts if turn.degrees < 0 else reversed(posts)
        gates.append({"name": turn.name, "left": left, "right": right})
    x, y, heading = path.point(path.length)
    at, across = np.array([x, y]), np.array([-math.sin(heading), math.cos(heading)])
    left, right = points([at + FINISH_LEFT * across, at - HALF_WIDTH * across])
    return [*gates, {"name": "F", "left": left, "right": right}]


def _middle(path: Centreline, ends: dict, turn: Turn) -> tuple[np.ndarray, np.ndarray]:
    """Return the middle of a turn, and the direction to its inside."""
    x, y, heading = path.point(sum(ends[turn.name]) / 2)
    left = np.array([-math.sin(heading), math.cos(heading)])
    return np.array([x, y]), math.copysign(1.0, turn.degrees) * left


def _to_wall(free: shapely.Polygon, at: np.ndarray, way_out: np.ndarray) -> float:
    """Return the distance to the walls' middle line in a direction."""
    hit = shapely.LineString([at, at + 4 * way_out]).intersection(free.boundary)
    return min(shapely.Point(at).distance(point) for point in shapely.get_parts(hit))


if __name__ == "__main__":
    write_course(lay_out, __doc__.splitlines()[0])
