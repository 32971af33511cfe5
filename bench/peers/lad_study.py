"""What this project ships: nothing here is faster than in a study."""

import numpy as np
from numpy.typing import NDArray
from peers.shipped_lap import drive_shipped_lap

from harness.world.bullet_world import BulletWorld
from lad.command import Command
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.study import LaserSettings


class LadStudy:
    """The world of a study, with a new scan in every step as the peers have it."""

    def __init__(self, course: Course, rays: int, rate_hz: int, caster: str = "sweep") -> None:
        self._course = course
        # Unvalidated, because a study may not have as few rays as the smallest case here.
        settings = LaserSettings.model_construct(rays=rays, caster=caster)
        self.world = BulletWorld(course, settings, period=1 / rate_hz, scan_period=1 / rate_hz)
        self.restart()

    def restart(self) -> None:
        """Stand still at the start."""
        self.world.reset(np.random.default_rng(0))

    def sense(self) -> tuple[Pose, NDArray[np.float64]]:
        """Observe."""
        seen = self.world.observe()
        return seen.pose, seen.ranges

    def velocity(self) -> Command:
        """Return how the chair moves."""
        return self.world.observe().velocity

    def step(self, command: Command) -> None:
        """Drive for one control period."""
        self.world.step(command)

    def drive_lap(self, time_limit_s: float) -> float:
        """Drive and record a lap as a study does."""
        return drive_shipped_lap(self.world, self._course, time_limit_s)

    def close(self) -> None:
        """Give the physics engine back."""
        self.world.close()
