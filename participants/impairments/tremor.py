"""Tremor: a rhythmic movement of the hand, added to the intended one."""

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

WORST = 4.0
"""The highest tremor rating; severity 1."""

LOG_SLOPE, LOG_INTERCEPT = 0.5, -2.0
"""log10 of a tremor's amplitude in cm, per point of its rating and at rating 0: Elble (2018),
Tremor and Other Hyperkinetic Movements 8, after Elble et al. (2006), Brain 129, 2660-2666."""

THROW = 1.5
"""How far the top of a wheelchair's stick travels from the middle to its end, cm: assumption."""

LOWEST, HIGHEST = 3.0, 12.0
"""Pathological tremors' frequencies, Hz: consensus statement, Bhatia et al. (2018), Movement
Disorders 33, 75-87 (parkinsonian and dystonic ones at the lower end, essential tremor 4 to 12)."""

WANDERING, WANDERING_TIME = 0.3, 1.0
"""A tremor's frequency wanders by this standard deviation, Hz, with this time constant, s:
assumption; rhythmic means that it does not wander far."""


class TremorOptions(Options):
    """What a protocol may set for a tremor.

    Attributes
    ----------
    frequency_hz
        Its frequency; None draws one for each person, any between 3 and 12 Hz being as likely.
    """

    frequency_hz: Annotated[float, Field(ge=LOWEST, le=HIGHEST)] | None = None


def amplitude(severity: float) -> float:
    """Return a tremor's amplitude on the stick, as a share of its full deflection.

    Ratings measure the logarithm of the amplitude; that at rating 0 is subtracted, so that
    severity 0 is none.

    Parameters
    ----------
    severity
        0 to 1: the rating, 0 to 4, over 4.

    Examples
    --------
    >>> [round(amplitude(severity), 3) for severity in (0.0, 0.25, 0.5, 0.75, 1.0)]
    [0.0, 0.014, 0.06, 0.204, 0.66]
    """
    at_zero: float = 10.0**LOG_INTERCEPT
    swing: float = at_zero * (10.0 ** (LOG_SLOPE * WORST * severity) - 1.0) / THROW
    return swing


class Tremor:
    """A driver whose hand trembles along one line of the stick's plane.

    A control step gets the mean of the stick over the step: what reaches the chair of a tremor
    that is faster than its controller. Above half the controller's rate it appears at a lower
    frequency, as in any sampled stick without a filter before it.

    Parameters
    ----------
    driver
        The driver that intends the commands.
    severity
        0 to 1; see ``amplitude``.
    frequency
        Hz; None for one drawn for this person.
    rng
        The tremor's own random numbers for the whole session.
    """

    def __init__(
        self, driver: Driver, severity: float, frequency: float | None, rng: np.random.Generator
    ) -> None:
        self._driver = driver
        self.kind = kind_of(driver)
        self._rng = rng
        line, drawn = rng.uniform(0.0, math.pi), rng.uniform(LOWEST, HIGHEST)
        size = amplitude(severity)
        self._swing = Command(
            size * math.sin(line) * MAX_SPEED, size * math.cos(line) * MAX_TURN_RATE
        )
        self._frequency = drawn if frequency is None else frequency
        self._t: float | None = None
        self._meant = STILL
        self._begin()

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap; the driver's own random numbers are the same as without tremor."""
        self._driver.start_lap(lap, rng)
        self._begin()

    def act(self, sight: Sight) -> Command | None:
        """Answer with the driver's command, trembling; the driver may have no new one."""
        meant = self._driver.act(sight)
        self._meant = self._meant if meant is None else meant
        passed = 0.0 if self._t is None else sight.t - self._t
        self._t = sight.t
        swing = self._mean_swing(passed)
        v, w = self._meant.v + swing * self._swing.v, self._meant.w + swing * self._swing.w
        return within_limits(Command(v, w))

    def _begin(self) -> None:
        (self._lap_rng,) = self._rng.spawn(1)
        self._phase = float(self._lap_rng.uniform(0.0, math.tau))
        self._off = WANDERING * float(self._lap_rng.normal())
        self._t = None
        self._meant = STILL

    def _mean_swing(self, passed: float) -> float:
        """Return the mean of the oscillation over the time that has passed, in [-1, 1]."""
        keep = math.exp(-passed / WANDERING_TIME)
        fresh = float(self._lap_rng.normal())
        self._off = keep * self._off + WANDERING * math.sqrt(1.0 - keep * keep) * fresh
        turned = math.tau * (self._frequency + self._off) * passed
        middle = self._phase + turned / 2.0
        self._phase = (self._phase + turned) % math.tau
        return float(np.sinc(turned / math.tau)) * math.sin(middle)


def tremor(setup: ImpairmentSetup) -> Tremor:
    """Return a driver with tremor; see ``TremorOptions``."""
    options = read_options("impairment 'tremor'", TremorOptions, setup.options)
    return Tremor(setup.driver, setup.severity, options.frequency_hz, setup.rng)
