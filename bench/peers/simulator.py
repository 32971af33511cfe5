"""What every simulator offers the loop, and where the chair and its laser are, in one place."""

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from protocols.pose import Pose

FIELD_OF_VIEW = math.radians(240.0)
"""Of the laser, centred ahead."""

RANGE = 4.0
"""Of the laser, m."""

PHYSICS_HZ = 240
"""Of those peers that step a rigid body engine: PyBullet's default."""

WHEEL_RADIUS = 0.16
TRACK = 0.40
CASTOR_RADIUS = 0.08
CASTOR_AHEAD = 0.45
CASTOR_ASIDE = 0.18
"""Of the peers' chairs, m."""


class Simulator(Protocol):
    """A wheelchair with a laser in a course."""

    def restart(self) -> None:
        """Stand still at the start."""

    def sense(self) -> tuple[Pose, NDArray[np.float64]]:
        """Return where the chair is, and the ranges from right to left, m; 4 without return."""

    def velocity(self) -> Command:
        """Return how the chair moves."""

    def step(self, command: Command) -> None:
        """Drive for one control period."""

    def drive_lap(self, time_limit_s: float) -> float:
        """Drive and record a lap, at most so long; return its length in simulated seconds."""

    def close(self) -> None:
        """Give everything back."""


def bearings(rays: int) -> NDArray[np.float64]:
    """Return each ray's direction in the chair's frame, rad, anticlockwise, from right to left."""
    return np.linspace(-FIELD_OF_VIEW / 2, FIELD_OF_VIEW / 2, rays)
