"""How well a navigation stack knows where it is."""

import math

import numpy as np

from protocols.pose import Pose

PLACE_ERROR = 0.03
"""Standard deviation of each coordinate's error, m: a particle filter's in a mapped room."""

HEADING_ERROR = 0.02
"""Standard deviation of the heading's error, rad."""

DRIFT_TIME = 2.0
"""Correlation time of the errors, s."""


class Localisation:
    """Estimates of a pose whose errors drift (an Ornstein-Uhlenbeck process each).

    Parameters
    ----------
    rng
        This lap's random numbers.
    """

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._errors = rng.normal(size=3)
        self._t: float | None = None

    def estimate(self, t: float, pose: Pose) -> Pose:
        """Return the estimated pose.

        Parameters
        ----------
        t
            Now, s; not before the last call's.
        pose
            The true pose.
        """
        passed = 0.0 if self._t is None else t - self._t
        self._t = t
        keep = math.exp(-passed / DRIFT_TIME)
        fresh = self._rng.normal(size=3)
        self._errors = keep * self._errors + math.sqrt(1.0 - keep * keep) * fresh
        x, y, heading = (float(error) for error in self._errors)
        return Pose(
            pose.x + PLACE_ERROR * x,
            pose.y + PLACE_ERROR * y,
            pose.heading + HEADING_ERROR * heading,
        )
