"""Notice that the chair stands although it was told to move."""

from lad.command import Command

MOVING = 0.03
"""Velocities below this count as standing, m/s and rad/s."""


class Standstill:
    """How long the chair has been standing against somebody's will."""

    def __init__(self) -> None:
        self.seconds = 0.0
        self._t: float | None = None

    def notice(self, t: float, velocity: Command, asked: Command) -> float:
        """Take in a moment and return for how many seconds it has lasted.

        Parameters
        ----------
        t
            Now, seconds since the lap started.
        velocity
            What the chair does.
        asked
            What it was last told to do.
        """
        passed = 0.0 if self._t is None else t - self._t
        self._t = t
        wanted = max(abs(asked.v), abs(asked.w)) > MOVING
        stands = max(abs(velocity.v), abs(velocity.w)) < MOVING
        self.seconds = self.seconds + passed if wanted and stands else 0.0
        return self.seconds
