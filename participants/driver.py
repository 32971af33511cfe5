"""The seam every driver fits: autonomous, human-like, replayed, or a living person."""

from typing import Literal, Protocol, get_args

import numpy as np

from lad.command import Command
from participants.sight import Sight

ParticipantKind = Literal["synthetic", "scripted", "live"]
"""What a driver is: a simulated person or program, a replayed log, or a living person."""

PARTICIPANT_KINDS: tuple[ParticipantKind, ...] = get_args(ParticipantKind)


class WithdrewError(Exception):
    """The participant ends the session; the message is the reason, in the participant's words."""


class Driver(Protocol):
    """Drives the wheelchair. An attribute ``kind`` may tell what it is (``kind_of``)."""

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap.

        Parameters
        ----------
        lap
            Position of the lap in the session, counted from 0.
        rng
            This driver's own random numbers for this lap.
        """

    def act(self, sight: Sight) -> Command | None:
        """Return a command for what there is to see; None when there is no new one yet.

        Raises
        ------
        WithdrewError
            When the participant wants to stop; the lap ends, and what happened is kept.
        """


def kind_of(driver: Driver) -> ParticipantKind:
    """Return a driver's ``kind``; synthetic for a driver without one.

    Parameters
    ----------
    driver
        Any driver.

    Raises
    ------
    ValueError
        When it is none of ``PARTICIPANT_KINDS``.

    Examples
    --------
    >>> kind_of(object())
    'synthetic'
    """
    kind: ParticipantKind = getattr(driver, "kind", "synthetic")
    if kind not in PARTICIPANT_KINDS:
        raise ValueError(f"driver: kind {kind!r}; allowed: {', '.join(PARTICIPANT_KINDS)}")
    return kind
