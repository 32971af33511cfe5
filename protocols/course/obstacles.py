"""Obstacles: walls and furniture as oriented boxes, and their outlines."""

import itertools
import math
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from protocols.course.schema import Course, Point, Wall


class Box(NamedTuple):
    """A box standing on the floor.

    Attributes
    ----------
    cx, cy
        Centre on the floor plan, m.
    heading
        Direction of its length, rad.
    length, width, height
        Size, m.
    name
        The wall or piece of furniture it belongs to.
    """

    cx: float
    cy: float
    heading: float
    length: float
    width: float
    height: float
    name: str

    def corners(self) -> NDArray[np.float64]:
        """Return the corners on the floor plan, shape (4, 2), anticlockwise."""
        along = np.array([math.cos(self.heading), math.sin(self.heading)]) * self.length / 2
        across = np.array([-math.sin(self.heading), math.cos(self.heading)]) * self.width / 2
        centre = np.array([self.cx, self.cy])
        return np.array(
            [
                centre + along + across,
                centre - along + across,
                centre - along - across,
                centre + along - across,
            ]
        )


def obstacle_boxes(course: Course) -> tuple[Box, ...]:
    """Return everything the chair can hit, as boxes: walls piece by piece, then furniture."""
    walls = (box for wall in course.walls for box in _pieces(wall))
    furniture = (
        Box(f.x, f.y, f.heading, f.length, f.width, f.height, f.name) for f in course.furniture
    )
    return (*walls, *furniture)


def _pieces(wall: Wall) -> list[Box]:
    """Cut a wall into straight boxes that overlap at the bends, so that no gap shows outside."""
    points = [*wall.points, wall.points[0]] if wall.closed else list(wall.points)
    n = len(points) - 1
    boxes = []
    for i, (a, b) in enumerate(itertools.pairwise(points)):
        before = points[i - 1] if i > 0 else (points[-2] if wall.closed else None)
        after = points[i + 2] if i + 2 <= n else (points[1] if wall.closed else None)
        back = _overlap(before, a, b, wall.thickness)
        ahead = _overlap(a, b, after, wall.thickness)
        heading = math.atan2(b[1] - a[1], b[0] - a[0])
        shift = (ahead - back) / 2
        boxes.append(
            Box(
                (a[0] + b[0]) / 2 + shift * math.cos(heading),
                (a[1] + b[1]) / 2 + shift * math.sin(heading),
                heading,
                math.dist(a, b) + back + ahead,
                wall.thickness,
                wall.height,
                wall.name,
            )
        )
    return boxes


def _overlap(a: Point | None, b: Point, c: Point | None, thickness: float) -> float:
    """How far a piece reaches past a bend: to the mitre, but no farther than a square corner's."""
    if a is None or c is None:
        return 0.0
    into = math.atan2(b[1] - a[1], b[0] - a[0])
    out = math.atan2(c[1] - b[1], c[0] - b[0])
    turn = abs(math.remainder(out - into, math.tau))
    return thickness / 2 * min(1.0, math.tan(turn / 2))


def segments(course: Course) -> NDArray[np.float64]:
    """Return the outline edges of every box: shape (n, 4), columns x1, y1, x2, y2 in metres."""
    corners = np.array([box.corners() for box in obstacle_boxes(course)])
    edges = np.concatenate([corners, np.roll(corners, -1, axis=1)], axis=2)
    return np.ascontiguousarray(edges.reshape(-1, 4))


FloorPlan = shapely.Polygon | shapely.MultiPolygon


def floor_plan(course: Course) -> FloorPlan:
    """Return the union of all boxes as seen from above."""
    polygons = [shapely.Polygon(box.corners()) for box in obstacle_boxes(course)]
    merged = shapely.union_all(polygons)
    if not isinstance(merged, shapely.Polygon | shapely.MultiPolygon):  # pragma: no cover
        raise TypeError(f"boxes united to a {merged.geom_type}")
    return merged
