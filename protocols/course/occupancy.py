"""The course as a raster: what is free, and how far the nearest obstacle is."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from protocols.course.obstacles import Box, obstacle_boxes
from protocols.course.schema import Course

MARGIN = 0.5
"""How far the raster reaches past the outermost obstacle, start, gate or centreline, m."""

REACH = 10.0
"""No farther than this past the start, the gates and the centreline, m: what stands beyond does
not matter, and must not cost memory."""

FAR = 8.0
"""Larger distances count as this one, m: no driver keeps farther away."""


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
        Same shape: distance from the cell's centre to the nearest obstacle, m; 0 inside one, at
        most ``FAR``. An obstacle thinner than a cell may cover no centre: use this, not
        ``free`` alone.
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
    low_x, low_y, high_x, high_y = bounds(course)
    columns = math.ceil((high_x - low_x) / cell) + 1
    rows = math.ceil((high_y - low_y) / cell) + 1
    x = np.asarray(low_x + cell * np.arange(columns), dtype=np.float64)
    y = np.asarray(low_y + cell * np.arange(rows), dtype=np.float64)
    square = np.full((rows, columns), FAR**2)
    for box in obstacle_boxes(course):
        _lower(square, box, x, y)
    distance = np.sqrt(square)
    return Occupancy((low_x, low_y), cell, distance > 0.0, distance)


def _lower(
    square: NDArray[np.float64], box: Box, x: NDArray[np.float64], y: NDArray[np.float64]
) -> None:
    """Lower the squared distances of the cells that a box can be the nearest obstacle of."""
    corners = box.corners()
    (left, bottom), (right, top) = corners.min(axis=0) - FAR, corners.max(axis=0) + FAR
    across = slice(*np.searchsorted(x, [left, right]))
    up = slice(*np.searchsorted(y, [bottom, top]))
    cos, sin = math.cos(box.heading), math.sin(box.heading)
    dx, dy = x[None, across] - box.cx, y[up, None] - box.cy
    past = np.maximum(np.abs(dx * cos + dy * sin) - box.length / 2, 0.0)
    beside = np.maximum(np.abs(dy * cos - dx * sin) - box.width / 2, 0.0)
    np.minimum(square[up, across], past * past + beside * beside, out=square[up, across])


def bounds(course: Course) -> tuple[float, float, float, float]:
    """Return the raster's extent, m: lowest x and y, highest x and y."""
    way = [p for gate in course.gates for p in (gate.left, gate.right)]
    way += [*course.centreline, (course.start.x, course.start.y)]
    corners = [box.corners() for box in obstacle_boxes(course)]
    every = np.concatenate([np.array(way), *corners])
    low = np.maximum(every.min(axis=0) - MARGIN, np.min(way, axis=0) - REACH)
    high = np.minimum(every.max(axis=0) + MARGIN, np.max(way, axis=0) + REACH)
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])
