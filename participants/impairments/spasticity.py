"""Spasticity-like bursts: now and then the hand jerks to a side, and lets go again."""

import math
from typing import Annotated

import numpy as np
from pydantic import Field

from lad.command import STILL, Command
from participants.driver import Driver, kind_of
from participants.options import Options, read_options
from participants.setup import ImpairmentSetup
from participants.sight import Sight
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE, within_limits

MOST_PER_S = 0.3
"""Bursts per second at severity 1: assumption."""

RISE, DECAY = 0.1, 0.6
"""Time constants with which a burst comes and goes, s: assumption; velocity-dependent catches of
a spastic muscle are brief (Lance, 1980)."""


class SpasticityOptions(Options):
    """What a protocol may say about spasticity.

    Attributes
    ----------
    bursts_per_s
        How often a burst begins, on average; None takes it from the severity.
    """

    bursts_per_s: Annotated[float, Field(ge=0.0, le=2.0)] | None = None


class Spasticity:
    """A driver whose hand jerks at random times, each time in a direction of its own.

    A burst is a push of up to ``severity`` of full deflection that rises and decays
    exponentially and is added to what is meant; the stick's ends hold. Bursts begin as a Poisson
    process; one that begins while another lasts replaces it. An idealisation, not a model of
    muscle.

    Parameters
    ----------
    driver
        Whose intentions they are.
    severity
        0 to 1: the largest push as a share of full deflection.
    bursts_per_s
        Rate of bursts.
    rng
        The impairment's own random numbers for the whole session.
    """

    def __init__(
        self, driver: Driver, severity: float, bursts_per_s: float, rng: np.random.Generator
    ) -> None:
        self._driver = driver
        self.kind = kind_of(driver)
        self._severity, self._rate, self._rng = severity, bursts_per_s, rng
        self._t: float | None = None
        self._meant = STILL
        self._begin()

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap; the driver's own random numbers stay as they would be without."""
        self._driver.start_lap(lap, rng)
        self._begin()

    def act(self, sight: Sight) -> Command | None:
        """Answer with the driver's command, jerked; the driver may have nothing new to say."""
        meant = self._driver.act(sight)
        self._meant = self._meant if meant is None else meant
        passed = 0.0 if self._t is None else sight.t - self._t
        self._t = sight.t
        push = self._push(passed)
        v, w = self._meant.v + push[0] * MAX_SPEED, self._meant.w + push[1] * MAX_TURN_RATE
        return within_limits(Command(v, w))

    def _begin(self) -> None:
        (self._lap_rng,) = self._rng.spawn(1)
        self._t = None
        self._age = math.inf
        self._towards = (0.0, 0.0)
        self._meant = STILL

    def _push(self, passed: float) -> tuple[float, float]:
        """Return the push after so many seconds more, as shares of full deflection."""
        luck, angle, size = (float(u) for u in self._lap_rng.random(3))
        self._age += passed
        if luck < 1.0 - math.exp(-self._rate * passed):
            reach = self._severity * size
            self._towards = (
                reach * math.cos(math.tau * angle),
                reach * math.sin(math.tau * angle),
            )
            self._age = 0.0
        if math.isinf(self._age):
            return 0.0, 0.0
        level = (1.0 - math.exp(-self._age / RISE)) * math.exp(-self._age / DECAY)
        return level * self._towards[0], level * self._towards[1]


def spasticity(setup: ImpairmentSetup) -> Spasticity:
    """Return a driver with bursts; see ``SpasticityOptions``."""
    options = read_options("impairment 'spasticity'", SpasticityOptions, setup.options)
    rate = options.bursts_per_s
    return Spasticity(
        setup.driver,
        setup.severity,
        MOST_PER_S * setup.severity if rate is None else rate,
        setup.rng,
    )
