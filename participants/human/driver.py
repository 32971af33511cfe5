"""A person in the chair, from the first lap to the last."""

import numpy as np

from lad.command import Command
from participants.cohort import typical_traits
from participants.human.hesitation import Hesitation
from participants.human.lap_behaviour import LapBehaviour
from participants.human.patience import Patience
from participants.human.practice import skill
from participants.human.room import KnownRoom, known_room
from participants.human.turn_response import TurnResponse
from participants.options import NoOptions, read_options
from participants.setup import DriverSetup
from participants.sight import Sight
from participants.traits import Traits


class HumanDriver:
    """A human-like driver.

    Parameters
    ----------
    traits
        How this person drives.
    room
        The room as the person knows it after being shown around.
    """

    def __init__(self, traits: Traits, room: KnownRoom) -> None:
        self._traits = traits
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
            self._traits, skilled, self._response, self._hesitation, room=self._room, rng=rng
        )

    def act(self, sight: Sight) -> Command:
        """Move the stick, or leave."""
        self._patience.check(sight.t)
        return self._now.act(sight)


def human_driver(setup: DriverSetup) -> HumanDriver:
    """Return a human-like driver; without traits, a typical one. It takes no options."""
    read_options("driver 'human'", NoOptions, setup.options)
    traits = setup.traits if setup.traits is not None else typical_traits()
    return HumanDriver(traits, known_room(setup.course))
