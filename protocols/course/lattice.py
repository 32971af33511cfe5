"""The floor as a lattice: cells the chair's axle may be in, and the moves between them."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from protocols.course.gates import crossing, forward
from protocols.course.occupancy import Occupancy
from protocols.course.schema import Course, Gate, Point
from protocols.wheelchair import WIDTH

COMFORT = 0.8
"""Distance from obstacles beyond which a path is not made to pass still farther away, m."""

DETOUR = 3.0
"""How many metres a metre along an obstacle at half the chair's width counts in addition."""

MOVES = tuple(
    sorted(
        (
            (rows, columns)
            for rows in range(-2, 3)
            for columns in range(-2, 3)
            if math.gcd(rows, columns) == 1
        ),
        key=lambda move: math.atan2(*move),
    )
)
"""Sixteen directions, anticlockwise: the eight neighbours, and the eight cells a chess knight
reaches; each as rows (along y) and columns (along x)."""

DIRECTIONS = np.array([math.atan2(*move) for move in MOVES])
"""Their angles, rad."""


@dataclass(frozen=True, slots=True)
class Lattice:
    """Open cells of a raster, numbered, and the sixteen moves from each.

    Attributes
    ----------
    raster
        Whose cells.
    rows, columns
        Shape (n,): where each open cell is.
    target
        Shape (n, 16): the number of the cell that a move leads to; -1 where that one is closed.
    cost
        Shape (n, 16): a move's length in m, near obstacles more.
    """

    raster: Occupancy
    rows: NDArray[np.int64]
    columns: NDArray[np.int64]
    target: NDArray[np.int32]
    cost: NDArray[np.float64]

    def points(self, cells: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the centres of cells by their numbers, shape (n, 2), m."""
        places = np.column_stack([self.columns[cells], self.rows[cells]]).astype(np.float64)
        return np.array(self.raster.origin, dtype=np.float64) + self.raster.cell * places

    def number(self, x: float, y: float) -> int | None:
        """Return the number of the cell that a point lies in; None when it is closed."""
        row, column = self.raster.index(x, y)
        found = np.flatnonzero((self.rows == row) & (self.columns == column))
        return int(found[0]) if len(found) else None

    def crossing(self, gate: Gate, margin: float = 0.0) -> NDArray[np.int8]:
        """Return which moves cross a gate's line, shape (n, 16).

        Parameters
        ----------
        gate
            The gate.
        margin
            How far from either post it is passed, m; in its middle where it is too narrow.

        Returns
        -------
        NDArray
            1 for a move that passes the gate in its direction, -1 for one that crosses the line
            in any other way, 0 for one that does not cross it.
        """
        share = min(margin / math.dist(gate.left, gate.right), 0.4)
        here = self.points(np.arange(len(self.rows)))
        crosses = np.zeros(self.target.shape, dtype=np.int8)
        for cell, move in self._astride(gate, here):
            (ax, ay), (bx, by) = here[cell].tolist(), here[self.target[cell, move]].tolist()
            if crossing(_between(gate, share), (ax, ay), (bx, by)) is not None:
                crosses[cell, move] = 1
            elif crossing(gate, (ax, ay), (bx, by)) is not None or (
                crossing(_backwards(gate), (ax, ay), (bx, by)) is not None
            ):
                crosses[cell, move] = -1
        return crosses

    def _astride(self, gate: Gate, here: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the moves near a gate that begin and end on different sides of its line."""
        middle = np.mean([gate.left, gate.right], axis=0)
        reach = math.dist(gate.left, gate.right) / 2 + 3 * self.raster.cell
        ahead = (here - np.array(gate.right)) @ np.array(forward(gate))
        near = np.hypot(*(here - middle).T) <= reach
        behind = ahead < 0
        moves = near[:, None] & (self.target >= 0) & (behind[:, None] != behind[self.target])
        # A move that ends on the line counts from both sides.
        moves |= near[:, None] & (self.target >= 0) & (np.abs(ahead[self.target]) < 1e-9)
        return np.argwhere(moves)


def lattice(raster: Occupancy, open_cells: NDArray[np.bool_]) -> Lattice:
    """Return the lattice of some of a raster's cells.

    Parameters
    ----------
    raster
        The course.
    open_cells
        Shape of the raster: which cells belong to it.
    """
    height, width = raster.free.shape
    lack = np.clip((COMFORT - raster.distance) / (COMFORT - WIDTH / 2), 0.0, 1.0)
    price = 1.0 + DETOUR * lack**2
    rows, columns = np.nonzero(open_cells)
    number = np.full((height, width), -1, dtype=np.int32)
    number[rows, columns] = np.arange(len(rows), dtype=np.int32)
    target = np.full((len(rows), len(MOVES)), -1, dtype=np.int32)
    cost = np.zeros(target.shape)
    for i, (up, across) in enumerate(MOVES):
        r, c = rows + up, columns + across
        inside = (r >= 0) & (r < height) & (c >= 0) & (c < width)
        r, c = np.where(inside, r, 0), np.where(inside, c, 0)
        target[:, i] = np.where(inside, number[r, c], -1)
        length = np.hypot(up, across) * raster.cell
        cost[:, i] = length * (price[rows, columns] + price[r, c]) / 2
    return Lattice(raster, rows, columns, target, cost)


def wide_enough(raster: Occupancy, half: float) -> NDArray[np.bool_]:
    """Return the cells that are farther than this from every obstacle, m."""
    return raster.free & (raster.distance >= half)


def crossings(course: Course, floor: Lattice) -> NDArray[np.int8]:
    """Return which moves cross each of a course's gates, shape (gates, n, 16)."""
    return np.array([floor.crossing(gate) for gate in course.gates])


def _backwards(gate: Gate) -> Gate:
    return Gate(name=gate.name, left=gate.right, right=gate.left)


def _between(gate: Gate, share: float) -> Gate:
    """Return a gate without a share of its length at either post."""
    if not share:
        return gate

    def point(at: float) -> Point:
        (ax, ay), (bx, by) = gate.left, gate.right
        return ax + at * (bx - ax), ay + at * (by - ay)

    return Gate(name=gate.name, left=point(share), right=point(1 - share))
