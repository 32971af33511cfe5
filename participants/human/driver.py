"""A person in the chair, from the first lap to the last."""

from typing import Annotated

import numpy as np
from pydantic import Field

from lad.command import Command
from participants.cohort import typical_traits
from participants.human.hesitation import Hesitation
from participants.human.lap_behaviour import LapBehaviour
from participants.human.patience import Patience
from participants.human.practice import skill
from participants.human.room import KnownRoom, known_room
from participants.human.turn_response import TurnResponse
from participants.options import Options, read_options
from participants.setup import DriverSetup
from participants.sight import Sight
from participants.traits import Traits


class HumanOptions(Options):
    """What a protocol may say about human-like drivers.

    Attributes
    ----------
    compliance_to_person, compliance_to_machine
        Share of the deflection given up while a demonstrator, or the model, drives; None for the
        person's own trait ``compliance``, the same towards both. An assumption, like the trait:
        nothing published says how they differ.
    """

    compliance_to_person: Annotated[float, Field(ge=0.0, le=1.0)] | None = None
    compliance_to_machine: Annotated[float, Field(ge=0.0, le=1.0)] | None = None

    def compliance(self) -> dict[str, float]:
        """Return what was given, by the helper's role."""
        given = {"demonstrator": self.compliance_to_person, "model": self.compliance_to_machine}
        return {role: share for role, share in given.items() if share is not None}


class HumanDriver:
    """A human-like driver.

    Parameters
    ----------
    traits
        How this person drives.
    room
        The room as the person knows it after being shown around.
    options
        What else a protocol may say.
    """

    def __init__(
        self, traits: Traits, room: KnownRoom, options: HumanOptions | None = None
    ) -> None:
        self._traits = traits
        self._compliance = {} if options is None else options.compliance()
        self._room = room
        self._response = TurnResponse(traits.adaptation_per_s)
        self._hesitation = Hesitation(
            traits.limit_pause_s, traits.practice_exponent, self._response
        )
        self.start_lap(0, np.random.default_rng(0))

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Begin a lap; what was learnt about the chair stays."""
        self._response.start_lap()
        self._hesitation.start_lap()
        skilled = skill(self._traits, lap)
        (for_patience,) = rng.spawn(1)
        self._patience = Patience(self._traits.patience_s, for_patience)
        self._now = LapBehaviour(
            self._traits,
            skilled,
            self._response,
            self._hesitation,
            room=self._room,
            rng=rng,
            compliance=self._compliance,
        )

    def act(self, sight: Sight) -> Command:
        """Move the stick, or leave."""
        self._patience.check(sight.t)
        return self._now.act(sight)


def human_driver(setup: DriverSetup) -> HumanDriver:
    """Return a human-like driver; without traits, a typical one. See ``HumanOptions``."""
    options = read_options("driver 'human'", HumanOptions, setup.options)
    traits = setup.traits if setup.traits is not None else typical_traits()
    return HumanDriver(traits, known_room(setup.course), options)
