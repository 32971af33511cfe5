"""How the driver's and the assistant's commands are combined."""

from collections.abc import Callable
from typing import Literal

from lad.assistant import Assistance
from lad.command import Command
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

Arbitration = Callable[[Command, Assistance], Command]


def takeover(user: Command, assistance: Assistance) -> Command:
    """Let the assistant's command replace the driver's while it helps (section IV.B).

    Examples
    --------
    >>> takeover(Command(0.3, -0.15), Assistance(helping=True, command=Command(0.2, -0.5)))
    Command(v=0.2, w=-0.5)
    """
    if assistance.helping and assistance.command is not None:
        return assistance.command
    return user


def augment(user: Command, assistance: Assistance) -> Command:
    """Add the assistant's command to the driver's while it helps, within the chair's limits.

    The paper's alternative to the takeover (section IV.B).

    Examples
    --------
    >>> augment(Command(0.25, -0.15), Assistance(helping=True, command=Command(0.25, -0.5)))
    Command(v=0.5, w=-0.5)
    """
    if not assistance.helping or assistance.command is None:
        return user
    return Command(
        min(max(user.v + assistance.command.v, -MAX_SPEED), MAX_SPEED),
        min(max(user.w + assistance.command.w, -MAX_TURN_RATE), MAX_TURN_RATE),
    )


ARBITRATIONS: dict[Literal["takeover", "augment"], Arbitration] = {
    "takeover": takeover,
    "augment": augment,
}
