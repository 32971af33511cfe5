"""The wheelchair: its size, its largest speeds and accelerations, and what it accepts.

A paediatric powered wheelchair like ARTY's (Soh & Demiris 2013, section V); the top speeds are
those of section IV.A.
"""

import math

from lad.command import Command

MAX_SPEED = 0.7
"""Top translational speed, m/s."""

MAX_TURN_RATE = 0.5
"""Top rotational speed, rad/s."""

ACCELERATION = 0.7
"""Translational acceleration the controller allows, m/s^2, speeding up and braking."""

TURN_ACCELERATION = 1.5
"""Rotational acceleration the controller allows, rad/s^2."""

WIDTH = 0.55
"""Overall width, m."""

FRONT = 0.62
"""How far the chair reaches ahead of the driven axle, m."""

REAR = 0.23
"""How far the chair reaches behind the driven axle, m."""

LASER_AHEAD = 0.60
"""The laser's mounting point ahead of the driven axle, m."""

LASER_RANGE = 4.0
"""A laser reading of this or more means that nothing returned, m."""

LASER_HEIGHT = 0.30
"""The laser's height above the floor, m: anything lower is not seen."""


def within_limits(command: Command) -> Command:
    """Return the nearest command the chair accepts.

    Parameters
    ----------
    command
        Velocities asked for, in m/s and rad/s.

    Raises
    ------
    ValueError
        When the command is not finite.

    Examples
    --------
    >>> within_limits(Command(0.9, -0.2))
    Command(v=0.7, w=-0.2)
    """
    if not (math.isfinite(command.v) and math.isfinite(command.w)):
        raise ValueError(f"a command must be finite; got v={command.v}, w={command.w}")
    v = min(max(command.v, -MAX_SPEED), MAX_SPEED)
    w = min(max(command.w, -MAX_TURN_RATE), MAX_TURN_RATE)
    return Command(v, w)
