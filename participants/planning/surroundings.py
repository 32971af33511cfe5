"""Obstacles around the chair, also where its laser does not look."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from participants.planning.field import (
    ASIDE,
    BEHIND,
    CELL,
    COLUMNS,
    FAR,
    ROWS,
    DistanceField,
    known_field,
)
from protocols.course.occupancy import Occupancy, occupancy
from protocols.course.schema import Course
from protocols.pose import Pose


@lru_cache(maxsize=16)
def known_raster(course: Course) -> Occupancy:
    """Return a course's raster, made once for all who know the room."""
    return occupancy(course)


def map_field(raster: Occupancy, pose: Pose) -> DistanceField:
    """Return the distance field around a pose from the course's raster.

    Parameters
    ----------
    raster
        The course.
    pose
        Where the chair is.

    Returns
    -------
    DistanceField
        As of ``participants.planning.field.scan_field``, but of everything around.
    """
    ahead = CELL * np.arange(COLUMNS) - BEHIND
    left = (CELL * np.arange(ROWS) - ASIDE)[:, None]
    c, s = math.cos(pose.heading), math.sin(pose.heading)
    columns = (pose.x + c * ahead - s * left - raster.origin[0]) / raster.cell
    rows = (pose.y + s * ahead + c * left - raster.origin[1]) / raster.cell
    found = ndimage.map_coordinates(raster.distance, [rows, columns], order=1, mode="nearest")
    # Both rasters give the centre's distance for the whole cell.
    distance: NDArray[np.float64] = np.clip(found - CELL / math.sqrt(2.0), 0.0, FAR)
    return known_field(distance)
