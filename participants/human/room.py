"""The room as a person knows it: the way through, its sharp corners, and what stands where."""

import math
from functools import lru_cache

import numpy as np

from participants.human.corners import sharp_corners
from participants.planning.surroundings import known_raster
from protocols.course.occupancy import Occupancy
from protocols.course.route import Route, plan_route
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.wheelchair import WIDTH

STEP = 0.1
"""How finely a straight line is looked along, m."""


class KnownRoom:
    """What being shown around tells about a course.

    Parameters
    ----------
    route
        The way through.
    raster
        What stands where.
    """

    def __init__(self, route: Route, raster: Occupancy) -> None:
        self.route = route
        self.raster = raster
        self.corners = sharp_corners(route)

    def straight(self, pose: Pose, x: float, y: float) -> bool:
        """Return whether the chair has room on the straight line to a point."""
        n = math.ceil(math.hypot(x - pose.x, y - pose.y) / STEP) + 1
        shares = np.linspace(0.0, 1.0, n)[1:]
        rows = (pose.y + shares * (y - pose.y) - self.raster.origin[1]) / self.raster.cell
        columns = (pose.x + shares * (x - pose.x) - self.raster.origin[0]) / self.raster.cell
        height, width = self.raster.free.shape
        i = np.clip(np.rint(rows).astype(np.int64), 0, height - 1)
        j = np.clip(np.rint(columns).astype(np.int64), 0, width - 1)
        return bool((self.raster.distance[i, j] > WIDTH / 2).all())


@lru_cache(maxsize=16)
def known_room(course: Course) -> KnownRoom:
    """Return a course as a person knows it, worked out once for each course."""
    return KnownRoom(plan_route(course), known_raster(course))
