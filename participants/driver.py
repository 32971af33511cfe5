"""The seam every driver fits: autonomous, human-like, replayed, or alive."""

from typing import Literal, Protocol, get_args

import numpy as np

from lad.command import Command
from participants.sight import Sight

ParticipantKind = Literal["synthetic", "scripted", "live"]
"""What a driver is: a simulated person or program, a replayed log, or a living person."""

PARTICIPANT_KINDS: tuple[ParticipantKind, ...] = get_args(ParticipantKind)


class WithdrewError(Exception):
    """The participant ends the session; the message says why, in the participant's terms."""


class Driver(Protocol):
    """Who sits in the wheelchair. An attribute ``kind`` may say what it is (``kind_of``)."""

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
        """Answer what one sees with a command; None when there is no new one yet.

        Raises
        ------
        WithdrewError
            When the participant wants to stop; the lap ends, and what happened is kept.
        """


def kind_of(driver: Driver) -> ParticipantKind:
    """Return what a driver says that it is; synthetic for one that does not say.

    Raises
    ------
    ValueError
        When it says something else than ``PARTICIPANT_KINDS``.
    """
    kind: ParticipantKind = getattr(driver, "kind", "synthetic")
    if kind not in PARTICIPANT_KINDS:
        raise ValueError(f"a driver is {', '.join(PARTICIPANT_KINDS)}; this one says {kind!r}")
    return kind
