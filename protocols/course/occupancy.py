"""The course as a raster: what is free, and how far the nearest obstacle is."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course

MARGIN = 0.5
"""How far the raster reaches past the outermost obstacle, start, gate or centreline, m."""


@dataclass(frozen=True, slots=True)
class Occupancy:
    """A raster of the floor.

    Attributes
    ----------
    origin
        x and y of the centre of cell (0, 0), m.
    cell
        Edge length of a cell, m.
    free
        Shape (rows, columns), rows along y, columns along x: whether a cell's centre is outside
        every obstacle.
    distance
        Same shape: distance from the cell's centre to the nearest obstacle, m; 0 inside one. An
        obstacle thinner than a cell may cover no centre: use this, not ``free`` alone.
    """

    origin: tuple[float, float]
    cell: float
    free: NDArray[np.bool_]
    distance: NDArray[np.float64]

    def index(self, x: float, y: float) -> tuple[int, int]:
        """Return (row, column) of the cell a point lies in, clamped to the raster's edge."""
        row = round((y - self.origin[1]) / self.cell)
        column = round((x - self.origin[0]) / self.cell)
        rows, columns = self.free.shape
        return min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)

    def centre(self, row: int, column: int) -> tuple[float, float]:
        """Return x and y of a cell's centre, m."""
        return self.origin[0] + column * self.cell, self.origin[1] + row * self.cell


def occupancy(course: Course, cell: float = 0.05) -> Occupancy:
    """Rasterise a course.

    Parameters
    ----------
    course
        The course.
    cell
        Edge length of a cell, m.
    """
    low_x, low_y, high_x, high_y = _bounds(course)
    columns = math.ceil((high_x - low_x) / cell) + 1
    rows = math.ceil((high_y - low_y) / cell) + 1
    xs, ys = np.meshgrid(low_x + cell * np.arange(columns), low_y + cell * np.arange(rows))
    square = np.full(xs.shape, np.inf)
    for box in obstacle_boxes(course):
        cos, sin = math.cos(box.heading), math.sin(box.heading)
        dx, dy = xs - box.cx, ys - box.cy
        past = np.maximum(np.abs(dx * cos + dy * sin) - box.length / 2, 0.0)
        beside = np.maximum(np.abs(dy * cos - dx * sin) - box.width / 2, 0.0)
        np.minimum(square, past * past + beside * beside, out=square)
    distance = np.sqrt(square)
    return Occupancy((low_x, low_y), cell, distance > 0.0, distance)


def _bounds(course: Course) -> tuple[float, float, float, float]:
    points = [p for gate in course.gates for p in (gate.left, gate.right)]
    points += [*course.centreline, (course.start.x, course.start.y)]
    points += [(x, y) for box in obstacle_boxes(course) for x, y in box.corners().tolist()]
    low, high = np.min(points, axis=0) - MARGIN, np.max(points, axis=0) + MARGIN
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])
