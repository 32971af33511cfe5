"""What a driver or an assistant asks of the wheelchair."""

from typing import NamedTuple


class Command(NamedTuple):
    """A velocity command, or a measured velocity.

    Attributes
    ----------
    v
        Translation in m/s, forward positive.
    w
        Rotation in rad/s, anticlockwise positive: right turns are negative.

    Examples
    --------
    >>> from lad.command import Command
    >>> Command(v=0.7, w=-0.5).w
    -0.5
    """

    v: float
    w: float


STILL = Command(0.0, 0.0)
