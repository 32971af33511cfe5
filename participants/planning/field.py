# ruff: noqa: PLR0917  # compiled code takes arrays apart from objects
"""How far the nearest laser return is, anywhere around the chair.

A few looks along one arc ask for some hundred of the field's 4,761 cells, so a cell's distance is
worked out when it is first asked for.
"""

from typing import Any, NamedTuple

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


REACH = int((FAR + SLACK) / CELL) + 1
"""A return more cells away than this is farther than ``FAR``."""

_UNKNOWN = np.full((ROWS, COLUMNS), -1.0)
_NOWHERE = np.zeros(0, dtype=np.int32)


class DistanceField(NamedTuple):
    """Distances around the chair, in its frame; rows from right to left, columns from behind.

    Attributes
    ----------
    known
        Shape (``ROWS``, ``COLUMNS``): a lower bound of the distance from anywhere in the cell to
        the nearest return, m, 0 at least and ``FAR`` at most; negative where it has not been
        worked out yet. ``distance_at`` fills it in.
    rows, columns
        Shape (n,): the cells with a return in them.
    """

    known: NDArray[np.float64]
    rows: NDArray[np.int32]
    columns: NDArray[np.int32]

    def whole(self) -> NDArray[np.float64]:
        """Work out every cell, and return all distances."""
        _fill(*self)
        return self.known


def known_field(distance: NDArray[np.float64]) -> DistanceField:
    """Return a field all of whose distances are known, shape (``ROWS``, ``COLUMNS``), m."""
    return DistanceField(distance, _NOWHERE, _NOWHERE)


def scan_field(
    ranges: NDArray[np.float64], bearings: NDArray[np.float64], laser: float, longest: float
) -> DistanceField:
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
    DistanceField
        What the scan does not show counts as free.
    """
    rows, columns = np.empty(len(ranges), np.int32), np.empty(len(ranges), np.int32)
    n = _occupied(ranges, bearings, laser, longest, rows, columns)
    return DistanceField(_UNKNOWN.copy(), rows[:n], columns[:n])


@compiled
def _occupied(
    ranges: Any, bearings: Any, laser: float, longest: float, rows: Any, columns: Any
) -> Any:
    """Fill in the cells with a return; return how many there are."""
    n = 0
    for i in range(len(ranges)):
        r = ranges[i]
        if not r < longest:
            continue
        column = int(np.floor((laser + r * np.cos(bearings[i]) + BEHIND) / CELL + 0.5))
        row = int(np.floor((r * np.sin(bearings[i]) + ASIDE) / CELL + 0.5))
        if not (0 <= row < ROWS and 0 <= column < COLUMNS):
            continue
        if n == 0 or row != rows[n - 1] or column != columns[n - 1]:  # neighbours share cells
            rows[n], columns[n] = row, column
            n += 1
    return n


@compiled
def distance_at(field: Any, row: int, column: int) -> Any:
    """Return a cell's distance, m, and keep it: exact between cell centres, less the slack."""
    known, rows, columns = field
    if known[row, column] < 0.0:
        # Four bytes hold a squared distance, and twice as many of them fit a vector register.
        best = np.int32(REACH * REACH)
        r, c = np.int32(row), np.int32(column)
        for i in range(len(rows)):
            up, across = np.int32(rows[i] - r), np.int32(columns[i] - c)
            best = min(best, np.int32(up * up + across * across))
        known[row, column] = min(max(CELL * np.sqrt(best) - SLACK, 0.0), FAR)
    return known[row, column]


@compiled
def _fill(known: Any, rows: Any, columns: Any) -> None:
    for row in range(ROWS):
        for column in range(COLUMNS):
            distance_at((known, rows, columns), row, column)
