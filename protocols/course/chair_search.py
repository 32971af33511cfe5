"""A way that the whole chair can take: it fits at every place in the direction it then has."""

import heapq
import math
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from lad.compiled import compiled
from protocols.course.footprint import DISC_RADIUS, disc_centres
from protocols.course.lattice import DIRECTIONS, Lattice, lattice, wide_enough
from protocols.course.occupancy import Occupancy
from protocols.course.schema import Course
from protocols.course.search import NoWayError, no_way
from protocols.wheelchair import WIDTH

BEND = 0.15
"""How many metres a change of direction to the next of the sixteen counts, m."""

ON_THE_SPOT = 0.8
"""The same while standing, m: a way that continues is better."""

POST = WIDTH / 2 + 0.15
"""How far from its posts a gate is passed, where it is wide enough, m."""


class _Leg(NamedTuple):
    """The floor around a way between two gates, and which moves pass the second one."""

    floor: Lattice
    crosses: NDArray[np.int8]
    fits: NDArray[np.bool_]


def chair_path(
    course: Course, raster: Occupancy, path: NDArray[np.float64], gates_at: list[int], reach: float
) -> NDArray[np.float64]:
    """Return a way near another one that the chair can take, turning as it goes.

    It is looked for from gate to gate, among the cells near the other way, in sixteen directions:
    each move turns by one of them at most, and the chair, covered by discs, must have room.

    Parameters
    ----------
    course, raster
        The course, and its raster.
    path
        Shape (n, 2): the other way, m.
    gates_at
        Index of the first point past each gate.
    reach
        How far from the other way to look, m.

    Returns
    -------
    NDArray
        Shape (m, 2): cell centres, m.

    Raises
    ------
    NoWayError
        When the chair cannot turn or pass somewhere.
    """
    open_cells = wide_enough(raster, WIDTH / 2)
    open_cells[raster.index(course.start.x, course.start.y)] = True
    ends = [0, *gates_at]
    seeds = {(*raster.index(course.start.x, course.start.y), _direction(course.start.heading)): 0.0}
    found: list[tuple[_Leg, NDArray[np.int64], dict[tuple[int, int, int], int]]] = []
    for gate, (first, last) in enumerate(pairwise(ends)):
        near = _near(raster, path[first : last + 1], reach)
        leg = _leg(course, gate, raster, open_cells & near)
        before, crossed = _explore(leg, seeds)
        if not crossed:
            raise _stuck(course, gate, leg, before)
        found.append((leg, before, {place: node for place, (_, node) in crossed.items()}))
        seeds = {place: cost for place, (cost, _) in crossed.items()}
    return _traced(found, min(seeds, key=lambda place: seeds[place]))


def _direction(angle: float) -> int:
    return int(np.argmin(np.abs(np.remainder(DIRECTIONS - angle + np.pi, math.tau) - np.pi)))


def _near(raster: Occupancy, path: NDArray[np.float64], reach: float) -> NDArray[np.bool_]:
    """Return the cells within reach of a way."""
    away = np.ones(raster.free.shape, dtype=np.bool_)
    for x, y in path:
        away[raster.index(float(x), float(y))] = False
    near: NDArray[np.bool_] = ndimage.distance_transform_edt(away) * raster.cell <= reach
    return near


def _leg(course: Course, gate: int, raster: Occupancy, cells: NDArray[np.bool_]) -> _Leg:
    floor = lattice(raster, cells)
    cos, sin = np.cos(DIRECTIONS)[:, None], np.sin(DIRECTIONS)[:, None]
    ahead, left = disc_centres().T
    discs = np.stack([ahead * cos - left * sin, ahead * sin + left * cos], axis=2) / raster.cell
    rooms = _rooms(raster.distance, floor.rows, floor.columns, discs)
    fits = rooms - DISC_RADIUS >= -raster.cell / 2
    return _Leg(floor, floor.crossing(course.gates[gate], POST), fits)


@compiled
def _rooms(distance: Any, rows: Any, columns: Any, discs: Any) -> Any:
    """Return the distance of the disc nearest to an obstacle, shape (n, 16), m.

    ``discs`` are the centres for each direction, in cells, shape (16, discs, 2): columns and rows.
    """
    height, width = distance.shape
    room = np.empty((len(rows), len(discs)))
    for i in range(len(rows)):
        for direction in range(len(discs)):
            least = np.inf
            for disc in range(discs.shape[1]):
                x = min(max(columns[i] + discs[direction, disc, 0], 0.0), width - 1.000001)
                y = min(max(rows[i] + discs[direction, disc, 1], 0.0), height - 1.000001)
                c, r = int(x), int(y)
                u, v = x - c, y - r
                below = (1 - u) * distance[r, c] + u * distance[r, c + 1]
                above = (1 - u) * distance[r + 1, c] + u * distance[r + 1, c + 1]
                least = min(least, (1 - v) * below + v * above)
            room[i, direction] = least
    return room


def _explore(
    leg: _Leg, seeds: dict[tuple[int, int, int], float]
) -> tuple[NDArray[np.int64], dict[tuple[int, int, int], tuple[float, int]]]:
    """Return each state's predecessor, and the states just past the gate: (cost, the one before).

    A state is a cell's number times 16 plus a direction; places are (row, column, direction).
    """
    floor = leg.floor
    places = zip(floor.rows.tolist(), floor.columns.tolist(), strict=True)
    number = {place: i for i, place in enumerate(places)}
    known = [(p, cost) for p, cost in seeds.items() if p[:2] in number]
    states = np.array([16 * number[p[:2]] + p[2] for p, _ in known], dtype=np.int64)
    costs = np.array([cost for _, cost in known], dtype=np.float64)
    best, before = _states((floor.target, floor.cost, leg.crosses), leg.fits, states, costs)
    crossed: dict[tuple[int, int, int], tuple[float, int]] = {}
    for cell, move in np.argwhere(leg.crosses == 1):
        there = int(floor.target[cell, move])
        for turn in (-1, 0, 1):
            state = 16 * int(cell) + (int(move) + turn) % 16
            cost = float(best[state] + floor.cost[cell, move] + BEND * abs(turn))
            place = (int(floor.rows[there]), int(floor.columns[there]), int(move))
            if np.isfinite(cost) and cost < crossed.get(place, (math.inf, 0))[0]:
                crossed[place] = (cost, state)
    return before, crossed


@compiled
def _states(floor: Any, fits: Any, states: Any, costs: Any) -> Any:
    """Return (each state's cost from the seeds, its predecessor); no move leads past the gate."""
    target, cost, crosses = floor
    n = target.shape[0] * 16
    best = np.full(n, np.inf)
    before = np.full(n, -1, dtype=np.int64)
    heap = [(0.0, 0)]
    heapq.heappop(heap)
    for i in range(len(states)):
        best[states[i]] = costs[i]
        heapq.heappush(heap, (costs[i], states[i]))
    while len(heap) > 0:
        so_far, state = heapq.heappop(heap)
        if so_far > best[state]:
            continue
        cell, direction = state // 16, state % 16
        for turn in (-1, 0, 1):
            move = (direction + turn) % 16
            if turn != 0 and fits[cell, move]:
                there = 16 * cell + move
                total = so_far + ON_THE_SPOT
                if total < best[there]:
                    best[there], before[there] = total, state
                    heapq.heappush(heap, (total, there))
            other = target[cell, move]
            if other < 0 or crosses[cell, move] != 0 or not fits[other, move]:
                continue
            there = 16 * int(other) + move
            total = so_far + cost[cell, move] + BEND * abs(turn)
            if total < best[there]:
                best[there], before[there] = total, state
                heapq.heappush(heap, (total, there))
    return best, before


def _stuck(course: Course, gate: int, leg: _Leg, before: NDArray[np.int64]) -> NoWayError:
    """Return the error with how near to a gate the chair comes."""
    states = np.flatnonzero(before >= 0)
    error = no_way(course, gate, "no way on which the chair can turn", WIDTH / 2)
    if not len(states):
        return error
    posts = np.array([course.gates[gate].left, course.gates[gate].right])
    reached = leg.floor.points(np.unique(states // 16))
    x, y = reached[int(np.argmin(np.hypot(*(reached - posts.mean(axis=0)).T)))]
    return NoWayError(course.name, gate, f"{error.reason}; it comes to ({x:.2f}, {y:.2f})")


def _traced(
    found: list[tuple[_Leg, NDArray[np.int64], dict[tuple[int, int, int], int]]],
    place: tuple[int, int, int],
) -> NDArray[np.float64]:
    """Return the way to a place, through the legs back to the start."""
    parts: list[NDArray[np.float64]] = []
    for leg, before, crossed in reversed(found):
        row, column, _ = place
        x0, y0 = leg.floor.raster.centre(row, column)
        parts.append(np.array([[x0, y0]]))
        state = crossed[place]
        states = [state]
        while before[states[-1]] >= 0:
            states.append(int(before[states[-1]]))
        cells = np.array([s // 16 for s in states], dtype=np.int64)
        parts.append(leg.floor.points(cells))
        first = int(cells[-1])
        place = (int(leg.floor.rows[first]), int(leg.floor.columns[first]), states[-1] % 16)
    way = np.vstack(parts)[::-1]
    moved = np.ones(len(way), dtype=np.bool_)
    moved[1:] = np.hypot(*np.diff(way, axis=0).T) > 0
    return way[moved]
