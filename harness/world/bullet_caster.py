"""Laser rays cast by PyBullet."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from harness.world.bullet import BulletRays
from protocols.course.obstacles import Box
from protocols.pose import Pose
from protocols.wheelchair import LASER_HEIGHT


class BulletCaster:
    """PyBullet's rays in the plane of the laser."""

    def __init__(self, boxes: Sequence[Box], bearings: NDArray[np.float64], reach: float) -> None:
        self._rays = BulletRays(boxes)
        self._bearings = bearings
        self._reach = reach

    def cast(self, sensor: Pose) -> NDArray[np.float64]:
        """Return the distances from a sensor's pose, shape (n_rays,), m."""
        starts = np.tile((sensor.x, sensor.y, LASER_HEIGHT), (len(self._bearings), 1))
        ends = starts.copy()
        directions = self._bearings + sensor.heading
        ends[:, 0] += self._reach * np.cos(directions)
        ends[:, 1] += self._reach * np.sin(directions)
        return self._rays.cast(starts, ends) * self._reach
