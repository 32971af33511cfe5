"""How far the nearest laser return is, everywhere around the chair."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled

CELL = 0.05
"""Edge length of a cell, m."""

BEHIND, AHEAD, ASIDE = 1.0, 2.4, 1.7
"""How far the field reaches from the middle of the axle, m."""

FAR = 1.5
"""Larger distances count as this one, m."""

ROWS = round(2 * ASIDE / CELL) + 1
COLUMNS = round((BEHIND + AHEAD) / CELL) + 1
SLACK = CELL * 2**0.5
"""A return and a query both count as their cell's centre: the error is at most this, m."""


def scan_field(
    ranges: NDArray[np.float64], bearings: NDArray[np.float64], laser: float, longest: float
) -> NDArray[np.float64]:
    """Return the distance field of one scan in the chair's frame.

    Parameters
    ----------
    ranges, bearings
        Shape (n,): the scan, in m and rad; what is ``longest`` or not finite returned nothing.
    laser
        The sensor's mounting point ahead of the axle, m.
    longest
        A range of this or more means that nothing was seen, m.

    Returns
    -------
    NDArray
        Shape (``ROWS``, ``COLUMNS``): rows from right to left, columns from behind to ahead. A
        lower bound of the distance from anywhere in the cell to the nearest return, m, 0 at least
        and ``FAR`` at most. What the scan does not show counts as free.
    """
    return _field(ranges, bearings, laser, longest)  # type: ignore[no-any-return]


@compiled
def _field(ranges: Any, bearings: Any, laser: float, longest: float) -> Any:
    """Exact squared distances between cell centres, in two passes (Felzenszwalb et al., 2012)."""
    reach = int((FAR + SLACK) / CELL) + 1
    # First pass: steps to the nearest occupied cell in the same row.
    steps = np.full((ROWS, COLUMNS), COLUMNS, dtype=np.int32)
    for i in range(len(ranges)):
        r = ranges[i]
        if not r < longest:
            continue
        column = int(np.floor((laser + r * np.cos(bearings[i]) + BEHIND) / CELL + 0.5))
        row = int(np.floor((r * np.sin(bearings[i]) + ASIDE) / CELL + 0.5))
        if 0 <= row < ROWS and 0 <= column < COLUMNS:
            steps[row, column] = 0
    occupied = np.empty(ROWS, dtype=np.bool_)
    for row in range(ROWS):
        for column in range(1, COLUMNS):
            steps[row, column] = min(steps[row, column], steps[row, column - 1] + 1)
        for column in range(COLUMNS - 2, -1, -1):
            steps[row, column] = min(steps[row, column], steps[row, column + 1] + 1)
        occupied[row] = steps[row, 0] < COLUMNS
    return _across(steps, occupied, reach)


@compiled
def _across(steps: Any, occupied: Any, reach: int) -> Any:
    """Second pass: over the rows within reach, nearest first, until none can be nearer."""
    field = np.full((ROWS, COLUMNS), FAR)
    for row in range(ROWS):
        best = np.full(COLUMNS, reach * reach, dtype=np.int32)
        for other in range(max(0, row - reach), min(ROWS, row + reach + 1)):
            if occupied[other]:
                apart = (row - other) ** 2
                for column in range(COLUMNS):
                    squared = apart + steps[other, column] ** 2
                    best[column] = min(best[column], squared)
        for column in range(COLUMNS):
            d = CELL * np.sqrt(best[column]) - SLACK
            field[row, column] = min(max(d, 0.0), FAR)
    return field
