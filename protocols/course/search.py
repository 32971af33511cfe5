"""The cheapest way over the floor of a course, through its gates in order."""

import heapq
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled
from protocols.course.lattice import crossings, lattice, wide_enough
from protocols.course.occupancy import Occupancy
from protocols.course.schema import Course
from protocols.files.errors import InputError
from protocols.wheelchair import WIDTH


class NoWayError(InputError):
    """No way leads through a course's gates.

    Parameters
    ----------
    course
        The course's name.
    gate
        The index of the first gate that cannot be passed.
    reason
        Why, as the rest of a sentence that begins with the gate.
    """

    def __init__(self, course: str, gate: int, reason: str) -> None:
        super().__init__(f"course {course!r}: {reason}")
        self.gate, self.reason = gate, reason


def cheapest_path(
    course: Course, raster: Occupancy, half: float = WIDTH / 2
) -> NDArray[np.float64]:
    """Return the cheapest path from the start through the gates in order.

    There is one layer of cells for each number of gates passed; a move across the next gate in its
    direction leads one layer up; none leads across it in any other way. Cells near an obstacle are
    closed, and those nearer than ``COMFORT`` cost more.

    Parameters
    ----------
    course, raster
        The course, and its raster.
    half
        Cells nearer to an obstacle than this are closed, m: half the width of what passes.

    Returns
    -------
    NDArray
        Shape (n, 2): cell centres from the start's cell to the first one past the last gate, m.

    Raises
    ------
    NoWayError
        When no path leads through all gates.
    """
    open_cells = wide_enough(raster, half)
    open_cells[raster.index(course.start.x, course.start.y)] = True
    floor = lattice(raster, open_cells)
    start = floor.number(course.start.x, course.start.y)
    reached, end, before = _dijkstra(floor.target, floor.cost, crossings(course, floor), start)
    if end < 0:
        raise no_way(course, int(reached), "no way", half)
    nodes = [int(end)]
    while before[nodes[-1]] >= 0:
        nodes.append(int(before[nodes[-1]]))
    return floor.points(np.array(nodes[::-1]) % len(floor.rows))


def no_way(course: Course, gate: int, what: str, half: float) -> NoWayError:
    """Return the error that no way leads to a gate."""
    previous = "the start" if gate == 0 else f"gate {course.gates[gate - 1].name}"
    reason = (
        f"{course.gates[gate].name}: {what} of the chair's width ({2 * half:.2f} m) leads there "
        f"from {previous}"
    )
    return NoWayError(course.name, gate, reason)


@compiled
def _dijkstra(target: Any, cost: Any, crosses: Any, start: Any) -> Any:
    """Return (gates passed at most, the end's node or -1, each node's predecessor)."""
    gates, cells, moves = crosses.shape
    best = np.full((gates + 1) * cells, np.inf)
    before = np.full((gates + 1) * cells, -1, dtype=np.int64)
    best[start] = 0.0
    heap = [(0.0, start)]
    reached = 0
    while len(heap) > 0:
        so_far, node = heapq.heappop(heap)
        if so_far > best[node]:
            continue
        layer, cell = node // cells, node % cells
        reached = max(reached, layer)
        if layer == gates:
            return layer, node, before
        for move in range(moves):
            other = target[cell, move]
            across = crosses[layer, cell, move]
            if other < 0 or across < 0:
                continue
            there = other + (layer + across) * cells
            total = so_far + cost[cell, move]
            if total < best[there]:
                best[there] = total
                before[there] = node
                heapq.heappush(heap, (total, there))
    return reached, -1, before
