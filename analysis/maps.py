"""Where on the floor plan something happened, as a smoothed density."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import shapely
from numpy.typing import NDArray
from scipy import ndimage

from protocols.course.obstacles import floor_plan
from protocols.course.schema import Course

CELL = 0.1
"""Edge of a grid cell, m."""

BANDWIDTH = 0.25
"""Standard deviation of the smoothing kernel, m: about half a chair's width."""

MARGIN = 4 * BANDWIDTH


@dataclass(frozen=True, slots=True)
class Grid:
    """Square cells over the floor plan; ``x`` and ``y`` are their edges, m."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, int]:
        """Rows (along y) and columns (along x)."""
        return len(self.y) - 1, len(self.x) - 1


def plan_grid(course: Course) -> Grid:
    """Return a grid that covers the course with room for the smoothing."""
    low_x, low_y, high_x, high_y = shapely.bounds(floor_plan(course))
    columns = math.ceil((high_x - low_x + 2 * MARGIN) / CELL)
    rows = math.ceil((high_y - low_y + 2 * MARGIN) / CELL)
    return Grid(
        low_x - MARGIN + CELL * np.arange(columns + 1), low_y - MARGIN + CELL * np.arange(rows + 1)
    )


def counts(x: NDArray[np.float64], y: NDArray[np.float64], grid: Grid) -> NDArray[np.float64]:
    """Return how many points are in each cell, shape of the grid."""
    histogram, _, _ = np.histogram2d(y, x, bins=(grid.y, grid.x))
    return histogram


def smoothed(histogram: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return counts smeared by a Gaussian kernel, their sum unchanged up to the grid's edge."""
    return np.asarray(
        ndimage.gaussian_filter(histogram, BANDWIDTH / CELL, mode="constant", truncate=4.0)
    )


def density(weight: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return smoothed counts as a density in 1/m^2 that integrates to 1; all NaN without any."""
    total = weight.sum()
    return weight / (total * CELL**2) if total > 0 else np.full(weight.shape, np.nan)


def participant_maps(
    steps: pd.DataFrame, participants: Sequence[str], grid: Grid
) -> NDArray[np.float64]:
    """Return each participant's smoothed counts of assisted steps, shape (participants, cells).

    Parameters
    ----------
    steps
        One row per step of one condition: participant, x_m, y_m, helped.
    participants
        The rows, in order; a participant who was never helped is a row of zeros.
    grid
        Cells of the floor plan.
    """
    helped = steps[steps["helped"] == 1]
    maps = np.zeros((len(participants), math.prod(grid.shape)))
    groups = {str(who): g for who, g in helped.groupby("participant", observed=True)}
    for row, who in enumerate(participants):
        if who in groups:
            x, y = (groups[who][c].to_numpy(dtype=np.float64) for c in ("x_m", "y_m"))
            maps[row] = smoothed(counts(x, y, grid)).ravel()
    return maps


def overlap(f: NDArray[np.float64], g: NDArray[np.float64]) -> float:
    """Return the overlap coefficient of two densities: 0 (disjoint) to 1 (the same).

    References
    ----------
    Inman & Bradley (1989), Communications in Statistics 18(10), 3851-3874.
    """
    return float(np.minimum(f, g).sum() * CELL**2)
