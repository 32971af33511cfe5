"""What the study does to the driver's command: turns are slowed, speed, lag, a dead zone.

Section IV.A of Soh & Demiris: "scaling right turns to a maximum of 0.15 rad/s". The others are
ours: they ask whether a finding about an assistant is one about right turns.
"""

import math
from collections.abc import Callable

from lad.command import STILL, Command
from protocols.condition import LimitationSettings
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

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


def left_turn_limit(left_turn_rad_s: float) -> Limitation:
    """Return the mirror image of ``right_turn_limit``."""

    def limited(command: Command) -> Command:
        if command.w <= 0:
            return command
        return Command(command.v, command.w * left_turn_rad_s / MAX_TURN_RATE)

    return limited


def speed_limit(speed_m_s: float) -> Limitation:
    """Return a limitation that scales translation: what full deflection still gives, m/s."""

    def limited(command: Command) -> Command:
        return Command(command.v * speed_m_s / MAX_SPEED, command.w)

    return limited


def dead_zone(share: float) -> Limitation:
    """Return a stick that does nothing below a share of its deflection, and all of it at the end.

    Examples
    --------
    >>> limited = dead_zone(0.5)
    >>> limited(Command(0.35, -0.25))
    Command(v=0.0, w=0.0)
    >>> limited(Command(0.7, -0.5))
    Command(v=0.7, w=-0.5)
    """

    def beyond(value: float, most: float) -> float:
        left = (abs(value) / most - share) / (1.0 - share)
        return math.copysign(min(left, 1.0) * most, value) if left > 0.0 else 0.0

    def limited(command: Command) -> Command:
        return Command(beyond(command.v, MAX_SPEED), beyond(command.w, MAX_TURN_RATE))

    return limited


def lag(lag_s: float, period_s: float) -> Limitation:
    """Return a chair that follows the stick with a first-order lag, from standing still.

    Parameters
    ----------
    lag_s
        Time constant, s.
    period_s
        Length of a control step, s.
    """
    follow = 1.0 - math.exp(-period_s / lag_s)
    now = STILL

    def limited(command: Command) -> Command:
        nonlocal now
        now = Command(now.v + follow * (command.v - now.v), now.w + follow * (command.w - now.w))
        return now

    return limited


def limitation_of(settings: LimitationSettings | None, period_s: float) -> Limitation:
    """Return what a condition does to the command, for one lap: a lag has a memory.

    The stick's dead zone comes first, then the scaling of speed and turns, then the lag.

    Parameters
    ----------
    settings
        The condition's; None for none.
    period_s
        Length of a control step, s.

    Examples
    --------
    >>> both = limitation_of(LimitationSettings(right_turn_rad_s=0.15, speed_m_s=0.35), 0.1)
    >>> both(Command(0.7, -0.5))
    Command(v=0.35, w=-0.15)
    """
    if settings is None:
        return unlimited
    parts: list[Limitation] = []
    if settings.dead_zone:
        parts.append(dead_zone(settings.dead_zone))
    if settings.speed_m_s is not None:
        parts.append(speed_limit(settings.speed_m_s))
    if settings.right_turn_rad_s is not None:
        parts.append(right_turn_limit(settings.right_turn_rad_s))
    if settings.left_turn_rad_s is not None:
        parts.append(left_turn_limit(settings.left_turn_rad_s))
    if settings.lag_s:
        parts.append(lag(settings.lag_s, period_s))
    return parts[0] if len(parts) == 1 else _in_turn(parts)


def _in_turn(parts: list[Limitation]) -> Limitation:
    def limited(command: Command) -> Command:
        for part in parts:
            command = part(command)
        return command

    return limited
