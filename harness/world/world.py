"""The seam every world fits: observe, safeguard and move, one control step at a time."""

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from protocols.pose import Pose


class Observation(NamedTuple):
    """What the instruments measure at the start of a control step.

    Attributes
    ----------
    t
        Seconds since the lap started.
    pose
        Ground truth.
    velocity
        Measured velocities, from odometry.
    ranges
        Shape (n_rays,): the last laser scan, noise included, from right to left, m.
    segments
        Shape (15,): its front half circle by nearest readings, from right to left, m.
    clearance_m
        Ground truth: from the chair's footprint to the nearest obstacle, 0 or more.
    contact
        Whether the chair touched an obstacle during the step before.
    """

    t: float
    pose: Pose
    velocity: Command
    ranges: NDArray[np.float64]
    segments: NDArray[np.float64]
    clearance_m: float
    contact: bool


class World(Protocol):
    """Where laps are driven, simulated or not."""

    @property
    def period(self) -> float:
        """Length of a control step, s."""

    @property
    def bearings(self) -> NDArray[np.float64]:
        """Directions of the laser's rays in the chair's frame, from right to left, rad."""

    @property
    def laser_offset(self) -> float:
        """The laser's mounting point ahead of the driven axle, m."""

    def reset(self, rng: np.random.Generator) -> None:
        """Place the chair at the start, at rest; ``rng`` is the lap's noise."""

    def observe(self) -> Observation:
        """Return the instruments' readings; a second call changes nothing."""

    def safeguard(self, command: Command) -> Command:
        """Return the command as the safeguard against hard collisions lets it through."""

    def step(self, command: Command) -> None:
        """Follow a command for one control step."""
