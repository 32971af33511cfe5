"""Weakness: the stick is pushed less far than intended."""

import numpy as np

from lad.command import Command
from participants.driver import Driver, kind_of
from participants.options import NoOptions, read_options
from participants.setup import ImpairmentSetup
from participants.sight import Sight

LEAST = 0.1
"""Share of a deflection that is left at severity 1; with 0 the chair could not be driven."""


class Weakness:
    """A driver who reaches only a share of the intended deflection.

    Both directions are scaled: a stick with a centring spring rests where the hand's force and
    the spring's are equal, so its deflection is proportional to the force. Scaled amplitude is
    how weakness of the hand is simulated by Schettino et al. (2025), Robotics 14(10):136, too.

    Parameters
    ----------
    driver
        The driver that intends the commands.
    severity
        0 leaves commands as they are, 1 leaves ``LEAST`` of them.
    """

    def __init__(self, driver: Driver, severity: float) -> None:
        self._driver = driver
        self.kind = kind_of(driver)
        self._share = 1.0 - severity * (1.0 - LEAST)

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap."""
        self._driver.start_lap(lap, rng)

    def act(self, sight: Sight) -> Command | None:
        """Answer with the reduced command of the driver."""
        meant = self._driver.act(sight)
        return None if meant is None else Command(self._share * meant.v, self._share * meant.w)


def weakness(setup: ImpairmentSetup) -> Weakness:
    """Return a driver with weakness; it takes no options."""
    read_options("impairment 'weakness'", NoOptions, setup.options)
    return Weakness(setup.driver, setup.severity)
