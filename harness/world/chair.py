"""The chair's velocity controller: it approaches the command within its acceleration limits."""

from lad.command import STILL, Command
from protocols.wheelchair import (
    ACCELERATION,
    TURN_ACCELERATION,
    within_limits,
)


def approached(velocity: Command, target: Command, dt: float) -> Command:
    """Return the velocity after some time of approach to a target velocity.

    Parameters
    ----------
    velocity
        Now.
    target
        The velocity to reach; within the chair's limits.
    dt
        How long, s.

    Examples
    --------
    >>> approached(Command(0.0, 0.0), Command(0.7, -0.1), 0.5)
    Command(v=0.35, w=-0.1)
    """
    dv, dw = ACCELERATION * dt, TURN_ACCELERATION * dt
    return Command(
        min(max(target.v, velocity.v - dv), velocity.v + dv),
        min(max(target.w, velocity.w - dw), velocity.w + dw),
    )


class VelocityController:
    """Turns commands into the velocities that the wheels get, step by step.

    Attributes
    ----------
    velocity
        What the wheels get now.
    """

    def __init__(self) -> None:
        self.velocity = STILL

    def reset(self, velocity: Command = STILL) -> None:
        """Start from a velocity: at rest, or the one that remains after a collision."""
        self.velocity = within_limits(velocity)

    def approach(self, target: Command, dt: float) -> bool:
        """Approach a target for a time; return whether the velocity changed."""
        if self.velocity == target:
            return False
        self.velocity = approached(self.velocity, target, dt)
        return True
