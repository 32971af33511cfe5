"""How the driver's and the assistant's commands are combined."""

from collections.abc import Callable

from lad.assistant import Assistance
from lad.command import Command
from protocols.condition import ArbitrationKind
from protocols.files.errors import InputError
from protocols.wheelchair import within_limits

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
    added = assistance.command
    return within_limits(Command(user.v + added.v, user.w + added.w))


def blend(user: Command, assistance: Assistance) -> Command:
    """Mix the two commands, the assistant's share being its p(h).

    The level of assistance then follows what the assistant believes, without a threshold
    (Kucukyilmaz & Demiris, 2018, learn such a level from demonstrations). Who says no probability,
    such as a demonstrator, has all of it while helping.

    Examples
    --------
    >>> surely = Assistance(helping=True, p_help=0.75, mean=Command(0.2, -0.5))
    >>> blend(Command(0.4, -0.1), surely)
    Command(v=0.25, w=-0.4)
    """
    if assistance.p_help is None or assistance.mean is None:
        return takeover(user, assistance)
    return _mixed(user, assistance.mean, assistance.p_help)


def blend_learnt(user: Command, assistance: Assistance) -> Command:
    """Mix the two commands, the assistant's share being the level that it has learnt.

    Of the shipped models only ``lad-level`` learns one. A demonstrator has all of it while helping.

    Raises
    ------
    InputError
        When the assistant predicts a command and no level.

    Examples
    --------
    >>> half = Assistance(helping=True, p_help=0.75, mean=Command(0.2, -0.5), share=0.5)
    >>> blend_learnt(Command(0.4, -0.1), half)
    Command(v=0.30000000000000004, w=-0.3)
    """
    if assistance.mean is None:
        return takeover(user, assistance)
    if assistance.share is None:
        raise InputError("arbitration blend-learnt: this model learns no level; allowed: lad-level")
    return _mixed(user, assistance.mean, assistance.share)


def _mixed(user: Command, other: Command, share: float) -> Command:
    return Command(
        (1.0 - share) * user.v + share * other.v, (1.0 - share) * user.w + share * other.w
    )


ARBITRATIONS: dict[ArbitrationKind, Arbitration] = {
    "takeover": takeover,
    "augment": augment,
    "blend": blend,
    "blend-learnt": blend_learnt,
}
