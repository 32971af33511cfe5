"""From intention to stick: lag, dead band, the stick's end, and noise that grows with effort."""

import math

import numpy as np

from lad.command import Command
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

DEAD_BAND = 0.02
"""Deflections below this share of the full one do nothing."""

OVERSHOOT = 1.5
"""How far beyond the stick's end an intention counts, as a share of full deflection."""

NOISE_TIME = 0.8
"""Correlation time of the noise, s: errors drift, they do not jump."""


class Stick:
    """One person's hand on the stick.

    Noise is proportional to the deflection (Harris & Wolpert, 1998) and an Ornstein-Uhlenbeck
    process in time; it enters before the lag. A stick at its end does not tremble.

    Parameters
    ----------
    lag
        Time constant with which the stick follows, s.
    noise
        Standard deviation as a share of the deflection.
    rng
        This lap's random numbers.
    """

    def __init__(self, lag: float, noise: float, rng: np.random.Generator) -> None:
        self._lag = lag
        self._noise = noise
        self._rng = rng
        self._errors = (float(rng.normal()), float(rng.normal()))
        self._pushed = (0.0, 0.0)

    def move(self, intention: Command, passed: float) -> Command:
        """Return the command of the stick a time after the last one.

        Parameters
        ----------
        intention
            What the person wants the chair to do, m/s and rad/s; may be beyond the stick's end.
        passed
            Seconds since the last call.
        """
        keep = math.exp(-passed / NOISE_TIME)
        spread = math.sqrt(1.0 - keep * keep)
        draw = self._rng.standard_normal
        error_v = keep * self._errors[0] + spread * draw()
        error_w = keep * self._errors[1] + spread * draw()
        follow = 1.0 - math.exp(-passed / self._lag)
        v, w = self._pushed
        v = self._push(v, intention.v / MAX_SPEED, error_v, follow)
        w = self._push(w, intention.w / MAX_TURN_RATE, error_w, follow)
        self._errors, self._pushed = (error_v, error_w), (v, w)
        return Command(_stick(v) * MAX_SPEED, _stick(w) * MAX_TURN_RATE)

    def _push(self, now: float, wanted: float, error: float, follow: float) -> float:
        reached = min(max(wanted, -OVERSHOOT), OVERSHOOT) * (1.0 + self._noise * error)
        return now + follow * (reached - now)


def _stick(pushed: float) -> float:
    """Return the stick's deflection: nothing in the dead band, no farther than its end."""
    return 0.0 if abs(pushed) < DEAD_BAND else min(max(pushed, -1.0), 1.0)
