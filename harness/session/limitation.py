"""The control limitation: right turns are slowed.

Section IV.A of Soh & Demiris: "scaling right turns to a maximum of 0.15 rad/s".
"""

from collections.abc import Callable

from lad.command import Command
from protocols.wheelchair import MAX_TURN_RATE

Limitation = Callable[[Command], Command]


def unlimited(command: Command) -> Command:
    """Leave the command as it is."""
    return command


def right_turn_limit(right_turn_rad_s: float) -> Limitation:
    """Return a limitation that scales right turns, so that full deflection gives less.

    Parameters
    ----------
    right_turn_rad_s
        What full deflection to the right still gives, in rad/s.

    Examples
    --------
    >>> limited = right_turn_limit(0.15)
    >>> limited(Command(0.7, -0.5))
    Command(v=0.7, w=-0.15)
    >>> limited(Command(0.7, 0.5))
    Command(v=0.7, w=0.5)
    """

    def limited(command: Command) -> Command:
        if command.w >= 0:
            return command
        return Command(command.v, command.w * right_turn_rad_s / MAX_TURN_RATE)

    return limited
