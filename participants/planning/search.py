"""The cheapest way over the raster of a course, through its gates in order."""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from protocols.course.gates import crossing
from protocols.course.occupancy import Occupancy
from protocols.course.schema import Course, Gate
from protocols.files.errors import InputError
from protocols.wheelchair import WIDTH

COMFORT = 0.8
"""Distance from obstacles beyond which more distance no longer makes a path cheaper, m."""

DETOUR = 3.0
"""How many metres a metre along an obstacle at half the chair's width counts in addition."""

MOVES = tuple(
    (rows, columns)
    for rows in range(-2, 3)
    for columns in range(-2, 3)
    if np.gcd(rows, columns) == 1
)
"""Sixteen directions: the eight neighbours, and the eight cells a chess knight reaches."""


def cheapest_path(course: Course, raster: Occupancy) -> NDArray[np.float64]:
    """Return the cheapest path from the start through the gates in order.

    The graph has one layer of cells for each number of gates passed; a move across the next gate
    in its direction leads one layer up. Cells nearer to an obstacle than half the chair's width
    are closed, and those nearer than ``COMFORT`` cost more.

    Returns
    -------
    NDArray
        Shape (n, 2): cell centres from the start's cell to the first one past the last gate, m.

    Raises
    ------
    InputError
        When no path leads through all gates.
    """
    cells = raster.free.size
    row, column = raster.index(course.start.x, course.start.y)
    start = row * raster.free.shape[1] + column
    costs, before = csgraph.dijkstra(
        _layered_graph(course, raster), indices=start, return_predecessors=True
    )
    last = len(course.gates) * cells
    end = last + int(np.argmin(costs[last:]))
    if not np.isfinite(costs[end]):
        passed = int(np.flatnonzero(np.isfinite(costs))[-1]) // cells
        raise InputError(
            f"course {course.name!r}: no way leads the chair to gate {course.gates[passed].name!r}"
        )
    nodes = [end]
    while nodes[-1] != start:
        nodes.append(int(before[nodes[-1]]))
    rows, columns = np.unravel_index(np.array(nodes[::-1]) % cells, raster.free.shape)
    cells_xy = np.column_stack([columns, rows]).astype(np.float64)
    return np.array(raster.origin, dtype=np.float64) + raster.cell * cells_xy


def _layered_graph(course: Course, raster: Occupancy) -> sparse.csr_array:
    moves, costs = _moves(raster)
    cells, gates = raster.free.size, course.gates
    # Past the last gate the search is over: nothing leaves that layer.
    sources = [moves[:, 0] + layer * cells for layer in range(len(gates))]
    targets = [
        moves[:, 1] + (layer + _passes(gate, raster, moves)) * cells
        for layer, gate in enumerate(gates)
    ]
    n = (len(gates) + 1) * cells
    return sparse.csr_array(
        (np.tile(costs, len(gates)), (np.concatenate(sources), np.concatenate(targets))),
        shape=(n, n),
    )


def _moves(raster: Occupancy) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the moves between open cells as flat indices, shape (m, 2), and their costs."""
    height, width = raster.free.shape
    open_cells = raster.free & (raster.distance >= WIDTH / 2)
    lack = np.clip((COMFORT - raster.distance) / (COMFORT - WIDTH / 2), 0.0, 1.0)
    price = (1.0 + DETOUR * lack**2).ravel()
    rows, columns = np.nonzero(open_cells)
    moves, costs = [], []
    for up, across in MOVES:
        r, c = rows + up, columns + across
        allowed = (r >= 0) & (r < height) & (c >= 0) & (c < width)
        allowed[allowed] = open_cells[r[allowed], c[allowed]]
        source, target = (rows * width + columns)[allowed], (r * width + c)[allowed]
        moves.append(np.column_stack([source, target]))
        length = np.hypot(up, across) * raster.cell
        costs.append(length * (price[source] + price[target]) / 2)
    return np.concatenate(moves), np.concatenate(costs)


def _passes(gate: Gate, raster: Occupancy, moves: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return 1 for each move that passes the gate in its direction, else 0."""
    rows, columns = np.unravel_index(moves, raster.free.shape)
    x = raster.origin[0] + raster.cell * columns
    y = raster.origin[1] + raster.cell * rows
    middle_x, middle_y = np.mean([gate.left, gate.right], axis=0)
    reach = np.hypot(gate.left[0] - middle_x, gate.left[1] - middle_y) + 3 * raster.cell
    passes = np.zeros(len(moves), dtype=np.int64)
    for i in np.flatnonzero(np.hypot(x[:, 0] - middle_x, y[:, 0] - middle_y) <= reach):
        a, b = (float(x[i, 0]), float(y[i, 0])), (float(x[i, 1]), float(y[i, 1]))
        passes[i] = crossing(gate, a, b) is not None
    return passes
