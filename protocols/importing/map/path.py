"""The cheapest way through the floor: short, and away from walls where there is room."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse import csgraph

from protocols import wheelchair
from protocols.course.schema import Point
from protocols.importing.map.floor import Floor

STEP_M = 0.05
"""Distance between the points of a path, and edge length of the cells it is sought on, m."""

SMOOTHING_M = 0.2
"""Standard deviation of the smoothing along the path, m: the cells' corners must not show."""

NEAR_WALLS = 6.0
"""How much dearer a metre is at a wall than in the open."""

_MOVES = ((0, 1), (1, 0), (1, 1), (1, -1))


@dataclass(frozen=True)
class _Grid:
    """Cells that the axle's midpoint may be in, and what a metre costs there."""

    passable: NDArray[np.bool_]
    cost: NDArray[np.float64]
    distance: NDArray[np.float64]
    cell: float

    def index(self, x: float, y: float) -> tuple[int, int]:
        """Return (row, column) of the cell a point lies in, clamped to the edge."""
        rows, columns = self.passable.shape
        row, column = int(y // self.cell), int(x // self.cell)
        return min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)


def path_through(floor: Floor, points: tuple[Point, ...], clearance: float) -> (
    NDArray[np.float64] | int
):  # fmt: skip
    """Return a smooth path through points in their order.

    Parameters
    ----------
    floor
        The floor.
    points
        The start, then the points to pass; in the map's own frame, m.
    clearance
        From here on, more distance from walls is not cheaper, m.

    Returns
    -------
    NDArray or int
        Shape (n, 2), m; or the index of the first point that cannot be reached by something as
        wide as the chair, 0 where the start itself has too little room.
    """
    grid = _grid(floor, clearance)
    if not grid.passable[grid.index(*points[0])]:
        return 0
    graph = _graph(grid)
    legs: list[NDArray[np.float64]] = []
    for i in range(1, len(points)):
        leg = _leg(grid, graph, points[i - 1], points[i])
        if leg is None:
            return i
        straight = _straightened(leg, grid, clearance)
        legs.append(straight if not legs else straight[1:])
    return _smoothed(np.concatenate(legs), grid)


def _grid(floor: Floor, clearance: float) -> _Grid:
    """Return the cells, made coarser where the map is finer than a path needs."""
    factor = max(1, round(STEP_M / floor.cell))
    distance = ndimage.distance_transform_edt(np.pad(floor.free, 1))[1:-1, 1:-1] * floor.cell
    rows, columns = (n // factor * factor for n in distance.shape)
    blocks = distance[:rows, :columns].reshape(rows // factor, factor, columns // factor, factor)
    distance = blocks.max(axis=(1, 3))
    passable = distance >= wheelchair.WIDTH / 2
    near = np.clip(1 - distance / clearance, 0, 1)
    return _Grid(passable, 1 + NEAR_WALLS * near**2, distance, floor.cell * factor)


def _graph(grid: _Grid) -> sparse.csr_matrix:
    """Return the cells as nodes, joined with their eight neighbours."""
    rows, columns = grid.passable.shape
    numbers = np.arange(rows * columns).reshape(rows, columns)
    froms, tos, costs = [], [], []
    for dr, dc in _MOVES:
        a = (slice(0, rows - dr), slice(max(0, -dc), columns - max(0, dc)))
        b = (slice(dr, rows), slice(max(0, dc), columns - max(0, -dc)))
        both = grid.passable[a] & grid.passable[b]
        froms.append(numbers[a][both])
        tos.append(numbers[b][both])
        mean = (grid.cost[a][both] + grid.cost[b][both]) / 2
        costs.append(mean * math.hypot(dr, dc) * grid.cell)
    parts = (np.concatenate(costs), (np.concatenate(froms), np.concatenate(tos)))
    return sparse.csr_matrix(parts, shape=(rows * columns,) * 2)


def _leg(
    grid: _Grid, graph: sparse.csr_matrix, begin: Point, end: Point
) -> NDArray[np.float64] | None:
    columns = grid.passable.shape[1]
    (r0, c0), (r1, c1) = grid.index(*begin), grid.index(*end)
    source, target = r0 * columns + c0, r1 * columns + c1
    _, before = csgraph.dijkstra(graph, directed=False, indices=source, return_predecessors=True)
    if source != target and before[target] < 0:
        return None
    nodes = [target]
    while nodes[-1] != source:
        nodes.append(int(before[nodes[-1]]))
    cells = np.array([divmod(node, columns) for node in reversed(nodes)], dtype=np.float64)
    path = (cells[:, ::-1] + 0.5) * grid.cell
    path[0], path[-1] = begin, end
    return path


def _straightened(leg: NDArray[np.float64], grid: _Grid, clearance: float) -> NDArray[np.float64]:
    """Return a leg without the detours of a path that knows eight directions only.

    A stretch becomes a straight line where that comes no nearer to walls than the stretch does, or
    keeps the clearance.
    """
    places = [grid.index(x, y) for x, y in leg.tolist()]
    room = np.array([grid.distance[place] for place in places])
    kept = [0]
    while kept[-1] < len(leg) - 1:
        i = kept[-1]
        least = np.minimum(np.minimum.accumulate(room[i:]), clearance) - grid.cell / 2
        ahead = (j for j in range(len(leg) - 1, i + 1, -1)
                 if _room(grid, leg[i], leg[j]) >= least[j - i])  # fmt: skip
        kept.append(next(ahead, i + 1))
    return leg[kept]


def _room(grid: _Grid, a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Return the least distance from walls on a straight line, m."""
    count = max(2, math.ceil(float(np.hypot(*(b - a))) / grid.cell) + 1)
    line = a + np.linspace(0, 1, count)[:, None] * (b - a)
    cells = (line // grid.cell).astype(np.int64)
    rows, columns = grid.passable.shape
    inside = (np.clip(cells[:, 1], 0, rows - 1), np.clip(cells[:, 0], 0, columns - 1))
    return float(grid.distance[inside].min())


def _smoothed(path: NDArray[np.float64], grid: _Grid) -> NDArray[np.float64]:
    """Return a path without the corners of the cells; it keeps its ends, and clear of walls."""
    even = _even(path, STEP_M)
    for sigma in (SMOOTHING_M, SMOOTHING_M / 2, SMOOTHING_M / 4):
        # Mirrored through its ends, so that they stay where they are.
        n = min(len(even) - 1, round(4 * sigma / STEP_M))
        head, tail = 2 * even[0] - even[n:0:-1], 2 * even[-1] - even[-2 : -n - 2 : -1]
        longer = np.concatenate([head, even, tail])
        smooth = ndimage.gaussian_filter1d(longer, sigma / STEP_M, axis=0)[n : n + len(even)]
        smooth[0], smooth[-1] = even[0], even[-1]
        places = [grid.index(x, y) for x, y in smooth.tolist()]
        if all(grid.passable[place] for place in places[1:-1]):
            return _even(smooth, STEP_M)
    return even


def _even(path: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Return points of a polyline at equal distances, both ends included."""
    lengths = np.hypot(*np.diff(path, axis=0).T)
    arcs = np.concatenate([[0.0], np.cumsum(lengths)])
    wanted = np.linspace(0, arcs[-1], max(2, math.ceil(arcs[-1] / step) + 1))
    return np.stack([np.interp(wanted, arcs, path[:, i]) for i in (0, 1)], axis=1)
