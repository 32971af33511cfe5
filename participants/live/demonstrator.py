"""A living person who watches and takes over."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from participants.live.driver import MOST_AGE_S, command_of
from participants.live.pictures import demonstrator_picture
from participants.live.seat import Input, Seat, occupied
from participants.setup import DemonstratorSetup
from participants.sight import Sight


class LiveDemonstrator:
    """Helps while a person's clutch is on; a person whose link is lost has let go.

    Parameters
    ----------
    seat
        Where the person sits.
    """

    def __init__(self, seat: Seat) -> None:
        self._seat = seat
        self._sight: Sight | None = None
        self._given: Input | None = None

    def start_lap(self) -> None:
        """Watch a new lap."""
        self._sight = None

    def look(self, sight: Sight) -> None:
        """See the room."""
        self._sight = sight

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Show the lap with the participant's stick, and answer with the person's own."""
        if self._sight is not None:
            self._seat.show(demonstrator_picture(self._sight, Command(float(x[0]), float(x[1]))))
        given = self._seat.latest()
        self._given = given
        if given is None or not given.clutch or given.age_s > MOST_AGE_S:
            return NO_ASSISTANCE
        return Assistance(helping=True, command=command_of(given))

    def telemetry(self) -> Mapping[str, Any]:
        """Return what is known about the person's link in this step, by column."""
        if self._given is None:
            return {}
        return {
            "demonstrator_device": self._given.device,
            "demonstrator_sent_age_s": self._given.age_s,
            "demonstrator_round_trip_s": self._given.round_trip_s,
            "demonstrator_v": self._given.forward,
            "demonstrator_w": self._given.left,
        }


def live_demonstrator(setup: DemonstratorSetup) -> LiveDemonstrator:
    """Return a demonstrator for a seat.

    Raises
    ------
    InputError
        When there is no seat: a living person cannot be simulated.
    """
    return LiveDemonstrator(occupied("demonstrator", setup.seat))
