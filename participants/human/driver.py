"""A person in the chair, from the first lap to the last."""

import numpy as np

from lad.command import Command
from participants.cohort import typical_traits
from participants.human.at_the_wheel import AtTheWheel
from participants.human.authority import Authority
from participants.human.doubt import Doubt
from participants.human.patience import Patience
from participants.human.practice import skill
from participants.human.room import KnownRoom, known_room
from participants.options import NoOptions, read_options
from participants.setup import DriverSetup
from participants.sight import Sight
from participants.traits import Traits


class HumanDriver:
    """A human-like driver.

    Parameters
    ----------
    traits
        Who it is.
    room
        The room, known from having been shown around.
    """

    def __init__(self, traits: Traits, room: KnownRoom) -> None:
        self._traits = traits
        self._room = room
        self._authority = Authority(traits.adaptation_per_s)
        self._doubt = Doubt(traits.limit_pause_s, traits.practice_exponent, self._authority)
        self.start_lap(0, np.random.default_rng(0))

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Begin a lap; what was learnt about the chair stays."""
        self._authority.start_lap()
        self._doubt.start_lap()
        skilled = skill(self._traits, lap)
        (for_patience,) = rng.spawn(1)
        self._patience = Patience(self._traits.patience_s, for_patience)
        self._now = AtTheWheel(
            self._traits, skilled, self._authority, self._doubt, room=self._room, rng=rng
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
