"""A living person in the chair."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from lad.command import STILL, Command
from participants.driver import ParticipantKind, WithdrewError
from participants.live.pictures import driver_picture
from participants.live.seat import Input, Request, Seat, occupied
from participants.setup import DriverSetup
from participants.sight import Sight
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

MOST_AGE_S = 0.2
"""An input that was sent longer ago never acts, s: after a stall, old ones arrive in a burst.

It acts for the step in which it is taken, so at 10 Hz the chair is told to stand within 0.3 s.
"""


def command_of(given: Input) -> Command:
    """Return the command that a stick's position asks for.

    Examples
    --------
    >>> command_of(Input(forward=1.0, left=-0.5))
    Command(v=0.7, w=-0.25)
    """
    return Command(given.forward * MAX_SPEED, given.left * MAX_TURN_RATE)


class LiveDriver:
    """Drives as a person's stick says; a person who is not heard is a person who stands.

    Parameters
    ----------
    seat
        Where the person sits.
    """

    kind: ParticipantKind = "live"

    def __init__(self, seat: Seat) -> None:
        self._seat = seat
        self._instructed = False
        self._sequence = 0
        self._given: Input | None = None

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:  # noqa: ARG002  # the seam's
        """Wait until the person starts the lap; before the first one, show the instructions."""
        if not self._instructed:
            self._seat.ask(Request("instructions"))
            self._instructed = True
        self._seat.ask(Request("ready"))

    def act(self, sight: Sight) -> Command | None:
        """Show what there is to see, and answer with the stick; None when it has not moved on.

        Without a connection, or with an input that is too old, the answer is to stand.

        Raises
        ------
        WithdrewError
            When the person wants to stop.
        """
        reason = self._seat.withdrawal()
        if reason is not None:
            raise WithdrewError(reason)
        self._seat.show(driver_picture(sight))
        given = self._seat.latest()
        self._given = given
        if given is None:
            self._sequence = 0  # the next connection counts from the start
            return STILL
        if given.age_s > MOST_AGE_S:
            return STILL
        if given.sequence == self._sequence:
            return None
        self._sequence = given.sequence
        return command_of(given)

    def telemetry(self) -> Mapping[str, Any]:
        """Return what is known about the person's link in this step, by column."""
        if self._given is None:
            return {}
        return {
            "driver_device": self._given.device,
            "driver_sent_age_s": self._given.age_s,
            "driver_round_trip_s": self._given.round_trip_s,
            "driver_frames": self._given.frames,
            "driver_attentive": self._given.attentive,
        }


def live_driver(setup: DriverSetup) -> LiveDriver:
    """Return a driver for a seat.

    Raises
    ------
    InputError
        When there is no seat: a living person cannot be simulated.
    """
    return LiveDriver(occupied("driver", setup.seat))
