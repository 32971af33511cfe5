"""The outline of the floor near the route, as walls."""

import itertools
import math
from dataclasses import dataclass
from typing import Any

import contourpy
import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.polygon import orient

from protocols.course.schema import MIN_STEP, Furniture, Point, Wall
from protocols.importing.map.floor import Floor
from protocols.importing.map.route import Simplification

THICKNESS = 0.02
"""Of a wall, m: thin, so that obstacles that are thin themselves keep both their faces."""

HEIGHT = 1.2
_MOST_POINTS = 1000


@dataclass(frozen=True)
class Walls:
    """What stands around the route.

    Attributes
    ----------
    floor
        The free floor between the walls' faces, in the map's own frame.
    walls, furniture
        Walls along its outline; obstacles in it that are too small for walls, as boxes.
    corners
        How many corners the outline had in the map, and has now.
    """

    floor: shapely.Polygon
    walls: tuple[Wall, ...]
    furniture: tuple[Furniture, ...]
    corners: tuple[int, int]


def walls_around(floor: Floor, path: NDArray[np.float64], simplify: Simplification) -> Walls | None:
    """Return the walls within reach of a path; None when the path is not on the floor.

    Walls stand half a thickness outside the floor's outline, so that their faces are where the
    map has them.
    """
    outline = _outline(floor)
    near = shapely.LineString(path).buffer(simplify.reach_m, quad_segs=4)
    cropped = shapely.intersection(outline, near)
    simple = cropped.simplify(simplify.tolerance_m, preserve_topology=True)
    on_path = shapely.Point(path[0])
    kept = next((p for p in shapely.get_parts(simple) if p.covers(on_path)), None)
    if not isinstance(kept, shapely.Polygon):
        return None
    furniture: list[Furniture] = []
    holes: list[shapely.LinearRing] = []
    for ring in kept.interiors:
        hole = shapely.Polygon(ring)
        if _is_slim(hole):
            furniture.append(_box(hole, len(furniture) + 1))
        else:
            holes.append(ring)
    grown = shapely.Polygon(kept.exterior, holes).buffer(THICKNESS / 2, join_style="mitre")
    shapes = [part for part in shapely.get_parts(grown) if isinstance(part, shapely.Polygon)]
    rings = [ring for part in shapes for ring in (part.exterior, *part.interiors)]
    walls = [wall for i, ring in enumerate(rings, start=1) for wall in _walls(ring, i)]
    before = shapely.get_num_coordinates(cropped)
    after = shapely.get_num_coordinates(kept)
    return Walls(kept, tuple(walls), tuple(furniture), (int(before), int(after)))


def _outline(floor: Floor) -> shapely.Geometry:
    """Return the floor's cells as polygons with holes."""
    padded = np.pad(floor.free.astype(np.float64), 1)
    middles = (np.arange(-1, max(padded.shape)) + 0.5) * floor.cell
    lines = contourpy.contour_generator(
        middles[: padded.shape[1]], middles[: padded.shape[0]], padded,
        fill_type=contourpy.FillType.OuterOffset,
    )  # fmt: skip
    filled: Any = lines.filled(0.5, 2.0)
    points, offsets = filled
    polygons = []
    for corners, starts in zip(points, offsets, strict=True):
        rings = [corners[a:b] for a, b in itertools.pairwise(starts)]
        polygons.append(shapely.Polygon(rings[0], rings[1:]))
    return shapely.make_valid(shapely.MultiPolygon(polygons))


def _is_slim(hole: shapely.Polygon) -> bool:
    """Tell whether walls of full thickness do not fit into an obstacle."""
    return bool(hole.buffer(-THICKNESS, join_style="mitre").is_empty)


def _box(hole: shapely.Polygon, number: int) -> Furniture:
    """Return the smallest box around an obstacle."""
    corners = shapely.get_coordinates(hole.minimum_rotated_rectangle)
    along, across = corners[1] - corners[0], corners[2] - corners[1]
    if np.hypot(*across) > np.hypot(*along):
        along, across = across, along
    centre = corners[:4].mean(axis=0)
    return Furniture(
        name=f"post {number}",
        x=_tidy(centre[0]),
        y=_tidy(centre[1]),
        heading=round(math.atan2(along[1], along[0]), 4),
        length=max(_tidy(float(np.hypot(*along))), 0.02),
        width=max(_tidy(float(np.hypot(*across))), 0.02),
        height=HEIGHT,
    )


def _walls(ring: shapely.LinearRing, number: int) -> list[Wall]:
    points = _distinct(shapely.get_coordinates(orient(shapely.Polygon(ring)).exterior)[:-1])
    if len(points) < 3:
        return []
    name = f"wall {number}"
    if len(points) <= _MOST_POINTS:
        return [Wall(name=name, points=points, closed=True, thickness=THICKNESS, height=HEIGHT)]
    around = (*points, points[0])
    starts = range(0, len(around) - 1, _MOST_POINTS - 1)
    return [
        Wall(
            name=f"{name} part {i}", points=around[a : a + _MOST_POINTS], thickness=THICKNESS,
            height=HEIGHT,
        )
        for i, a in enumerate(starts, start=1)
    ]  # fmt: skip


def _distinct(corners: NDArray[np.float64]) -> tuple[Point, ...]:
    """Return corners to the millimetre, those that fall together once."""
    points: list[Point] = []
    for x, y in corners.tolist():
        point = (_tidy(x), _tidy(y))
        if not points or math.dist(point, points[-1]) > MIN_STEP * 1.5:
            points.append(point)
    while len(points) > 1 and math.dist(points[0], points[-1]) <= MIN_STEP * 1.5:
        points.pop()
    return tuple(points)


def _tidy(value: float) -> float:
    return round(float(value), 3)
