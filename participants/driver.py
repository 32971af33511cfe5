"""The seam every driver fits: autonomous, human-like, replayed, or alive."""

from typing import Protocol

import numpy as np

from lad.command import Command
from participants.sight import Sight


class WithdrewError(Exception):
    """The participant ends the session; the message says why, in the participant's terms."""


class Driver(Protocol):
    """Who sits in the wheelchair."""

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
