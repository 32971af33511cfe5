"""What somebody in the room perceives in one step."""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from protocols.condition import AssistantRole
from protocols.pose import Pose


@dataclass(frozen=True, slots=True)
class Sight:
    """The room as a person in it, or a navigation stack with a map, perceives it.

    Attributes
    ----------
    t
        Seconds since the lap started.
    pose
        Where one sees oneself (a person), or localises oneself (a navigation stack).
    velocity
        The chair's velocities as felt, or from odometry.
    ranges
        Shape (n_rays,): the laser scan in metres, from right to left; 4.0 where nothing returned.
    bearings
        Shape (n_rays,): each ray's direction in the chair's frame, radians, anticlockwise.
    laser
        The sensor's mounting point ahead of the driven axle, in metres.
    gates_passed
        How many gates lie behind.
    helped
        Whether somebody else's command moved the chair in the step before: one notices.
    helper
        Whose command that was; ``none`` where nobody helped.
    """

    t: float
    pose: Pose
    velocity: Command
    ranges: NDArray[np.float64]
    bearings: NDArray[np.float64]
    laser: float
    gates_passed: int
    helped: bool
    helper: AssistantRole = "none"


@runtime_checkable
class Onlooker(Protocol):
    """An assistant who sees the room. The learned model is none: it gets its 19 inputs only."""

    def look(self, sight: Sight) -> None:
        """See the room as it is now; called before ``assist`` in every step."""
