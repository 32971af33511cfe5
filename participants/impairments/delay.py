"""Delay: the hand does what was meant some time ago."""

from collections import deque
from typing import Annotated

import numpy as np
from pydantic import Field

from lad.command import STILL, Command
from participants.driver import Driver, kind_of
from participants.options import Options, read_options
from participants.setup import ImpairmentSetup
from participants.sight import Sight

LONGEST_S = 1.0
"""Delay at severity 1, s: assumption; slowed initiation of movement adds tenths of a second."""


class DelayOptions(Options):
    """What a protocol may say about a delay.

    Attributes
    ----------
    delay_s
        How late the hand is; None takes it from the severity.
    """

    delay_s: Annotated[float, Field(ge=0.0, le=2.0)] | None = None


class Delay:
    """A driver whose commands arrive late; before the first one arrives, the stick is at rest.

    Parameters
    ----------
    driver
        Whose intentions they are.
    delay_s
        How late, s.
    """

    def __init__(self, driver: Driver, delay_s: float) -> None:
        self._driver = driver
        self.kind = kind_of(driver)
        self._delay = delay_s
        self._begin()

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap: nothing is on its way."""
        self._driver.start_lap(lap, rng)
        self._begin()

    def _begin(self) -> None:
        self._meant: deque[tuple[float, Command]] = deque()
        self._arrived = STILL

    def act(self, sight: Sight) -> Command | None:
        """Answer with what was meant a delay ago."""
        meant = self._driver.act(sight)
        if meant is not None:
            self._meant.append((sight.t + self._delay, meant))
        while self._meant and self._meant[0][0] <= sight.t + 1e-9:
            self._arrived = self._meant.popleft()[1]
        return self._arrived


def delay(setup: ImpairmentSetup) -> Delay:
    """Return a driver whose hand is late; see ``DelayOptions``."""
    options = read_options("impairment 'delay'", DelayOptions, setup.options)
    late = LONGEST_S * setup.severity if options.delay_s is None else options.delay_s
    return Delay(setup.driver, late)
