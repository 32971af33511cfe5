"""The room as a person knows it: the way through, its sharp corners, and where obstacles are."""

import math
from functools import lru_cache
from typing import Any

import numpy as np

from lad.compiled import compiled
from participants.human.corners import sharp_corners
from participants.human.passages import check_passages
from participants.planning.surroundings import known_raster
from protocols.course.occupancy import Occupancy
from protocols.course.route import Route, plan_route
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.wheelchair import WIDTH

STEP = 0.1
"""Distance between the points of a straight line that are checked, m."""


class KnownRoom:
    """What a person knows about a course after being shown around.

    Parameters
    ----------
    route
        The way through.
    raster
        Where obstacles are.
    """

    def __init__(self, route: Route, raster: Occupancy) -> None:
        self.route = route
        self.raster = raster
        self.corners = sharp_corners(route)

    def straight(self, pose: Pose, x: float, y: float) -> bool:
        """Return whether the chair has room on the straight line to a point."""
        looks = math.ceil(math.hypot(x - pose.x, y - pose.y) / STEP)
        raster = self.raster
        line = (pose.x, pose.y, x - pose.x, y - pose.y)
        return bool(_free(raster.distance, raster.origin, raster.cell, line, looks))


@compiled
def _free(distance: Any, origin: Any, cell: float, line: Any, looks: int) -> Any:
    """Whether half the chair fits at evenly spaced points of a line, its start left out."""
    x, y, dx, dy = line
    height, width = distance.shape
    for k in range(1, looks + 1):
        share = 1.0 if k == looks else k * (1.0 / looks)
        row = int(np.rint((y + share * dy - origin[1]) / cell))
        column = int(np.rint((x + share * dx - origin[0]) / cell))
        i, j = min(max(row, 0), height - 1), min(max(column, 0), width - 1)
        if not distance[i, j] > WIDTH / 2:
            return False
    return True


@lru_cache(maxsize=16)
def known_room(course: Course) -> KnownRoom:
    """Return a course as a person knows it, worked out once for each course.

    Raises
    ------
    InputError
        When it has a passage in which people give up.
    """
    route = plan_route(course)
    check_passages(course, route)
    return KnownRoom(route, known_raster(course))
