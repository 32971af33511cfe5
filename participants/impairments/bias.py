"""One-sided bias: the hand pulls the stick to one side, as after a stroke."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from lad.command import Command
from participants.driver import Driver, kind_of
from participants.options import Options, read_options
from participants.setup import ImpairmentSetup
from participants.sight import Sight
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE, within_limits

WORST = 0.4
"""Share of full deflection by which the stick is pulled at severity 1: assumption."""


class BiasOptions(Options):
    """What a protocol may say about a bias.

    Attributes
    ----------
    side
        Where the hand pulls; None gives each person a side.
    drift
        How much of the bias comes and goes with speed: 0 pulls the same whenever the stick is
        moved, 1 in proportion to the deflection forwards.
    """

    side: Literal["left", "right"] | None = None
    drift: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0


class Bias:
    """A driver whose stick stands farther to one side than meant; a stick let go is not pulled.

    Parameters
    ----------
    driver
        Whose intentions they are.
    pull
        Turn rate added to every command, rad/s, left positive.
    drift
        As in ``BiasOptions``.
    """

    def __init__(self, driver: Driver, pull: float, drift: float = 0.0) -> None:
        self._driver = driver
        self.kind = kind_of(driver)
        self._pull, self._drift = pull, drift

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap."""
        self._driver.start_lap(lap, rng)

    def act(self, sight: Sight) -> Command | None:
        """Answer with the driver's command, pulled to the side."""
        meant = self._driver.act(sight)
        if meant is None or meant == (0.0, 0.0):
            return meant
        share = 1.0 - self._drift + self._drift * min(abs(meant.v) / MAX_SPEED, 1.0)
        return within_limits(Command(meant.v, meant.w + share * self._pull))


def bias(setup: ImpairmentSetup) -> Bias:
    """Return a driver with a bias to one side; see ``BiasOptions``."""
    options = read_options("impairment 'bias'", BiasOptions, setup.options)
    drawn = "left" if setup.rng.random() < 0.5 else "right"
    sign = 1.0 if (options.side or drawn) == "left" else -1.0
    return Bias(setup.driver, sign * WORST * setup.severity * MAX_TURN_RATE, options.drift)
