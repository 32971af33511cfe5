"""The floor that can be reached from the start, as cells: specks dropped, slits closed."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from protocols.course.schema import Point
from protocols.importing.map.ros_map import RosMap
from protocols.importing.map.route import Route, Simplification

_EIGHT = np.ones((3, 3), dtype=bool)


@dataclass(frozen=True)
class Floor:
    """The reachable floor in the map's own frame.

    Attributes
    ----------
    free
        Shape (rows, columns): cells that are connected with the start.
    cell
        Edge length, m.
    specks
        How many obstacles were dropped because they are small.
    """

    free: NDArray[np.bool_]
    cell: float
    specks: int

    def index(self, x: float, y: float) -> tuple[int, int] | None:
        """Return (row, column) of the cell a point lies in; None outside the map."""
        row, column = int(y // self.cell), int(x // self.cell)
        rows, columns = self.free.shape
        return (row, column) if 0 <= row < rows and 0 <= column < columns else None


def walls_of(drawn: RosMap, route: Route) -> tuple[NDArray[np.bool_], int]:
    """Return which cells are walls, and how many specks were dropped."""
    walls = ~drawn.free if route.unknown == "wall" else drawn.occupied.copy()
    walls, specks = _without_specks(walls, drawn.cell, route.simplify)
    # Half the gap from either side meets in its middle.
    cells = round(route.simplify.closing_m / 2 / drawn.cell)
    if cells:
        padded = np.pad(walls, cells + 1, mode="edge")
        reached = ndimage.distance_transform_edt(~padded) <= cells
        kept = ndimage.distance_transform_edt(reached) > cells
        walls = walls | kept[cells + 1 : -cells - 1, cells + 1 : -cells - 1]
    return walls, specks


def _without_specks(
    walls: NDArray[np.bool_], cell: float, simplify: Simplification
) -> tuple[NDArray[np.bool_], int]:
    labels, count = ndimage.label(walls, structure=_EIGHT)
    sizes = np.bincount(labels.ravel(), minlength=count + 1) * cell**2
    small = sizes < simplify.specks_m2
    small[0] = False
    return walls & ~small[labels], int(small.sum())


def reachable(walls: NDArray[np.bool_], cell: float, start: Point, specks: int) -> Floor | None:
    """Return the floor that is connected with a point; None when the point is in a wall."""
    whole = Floor(~walls, cell, specks)
    place = whole.index(*start)
    if place is None or walls[place]:
        return None
    # Edges, not corners: what touches in a corner only cannot be passed.
    labels, _ = ndimage.label(~walls)
    return Floor(labels == labels[place], cell, specks)
