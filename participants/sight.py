"""What a driver or demonstrator in the room perceives in one step."""

from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from protocols.condition import AssistantRole
from protocols.pose import Pose


class Sight(NamedTuple):
    """The room as a person in it, or a navigation stack with a map, perceives it.

    Attributes
    ----------
    t
        Seconds since the lap started.
    pose
        The chair's pose as a person sees it, or as a navigation stack estimates it.
    velocity
        The chair's velocities as felt, or from odometry.
    ranges
        Shape (n_rays,): the laser scan in metres, from right to left; 4.0 where nothing returned.
    bearings
        Shape (n_rays,): each ray's direction in the chair's frame, radians, anticlockwise.
    laser
        The sensor's mounting point ahead of the driven axle, in metres.
    gates_passed
        How many gates the chair has passed.
    helped
        Whether another's command moved the chair in the step before: one notices.
    contact
        Whether the chair touched an obstacle in the step before: one feels it.
    helper
        Whose command that was; ``none`` without help.
    """

    t: float
    pose: Pose
    velocity: Command
    ranges: NDArray[np.float64]
    bearings: NDArray[np.float64]
    laser: float
    gates_passed: int
    helped: bool
    contact: bool = False
    helper: AssistantRole = "none"


@runtime_checkable
class Onlooker(Protocol):
    """An assistant that sees the room. The learned model does not: it gets only its 19 inputs."""

    def look(self, sight: Sight) -> None:
        """See the room as it is now; called before ``assist`` in every step."""
