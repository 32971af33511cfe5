"""A laser scanner like the Hokuyo URG-04LX: what it measures, and its front as 15 segments.

Its data sheet: 240 degrees in steps of 360/1024 degrees (682 of them), 0.02 to 4.095 m, 10 scans
per second, accuracy 10 mm up to 1 m and 1% of the distance beyond, resolution 1 mm. The accuracy
is taken as three standard deviations of an independent normal error: 3 mm near by, which is the
repeatability Kneip, Tache, Caprari & Siegwart (2009, "Characterization of the compact Hokuyo
URG-04LX 2D laser range scanner") report for well reflecting targets.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from harness.world.ray_sweep import RaySweep
from lad.compiled import compiled
from lad.inputs import N_SEGMENTS
from protocols.course.obstacles import Box
from protocols.pose import Pose
from protocols.wheelchair import LASER_HEIGHT, LASER_RANGE

FULL_STEPS = 682
SPAN = (FULL_STEPS - 1) * math.tau / 1024
"""Angle between the outermost rays, rad: 239.4 degrees."""

SCAN_PERIOD = 0.1
"""Time between scans, s."""

REACH = 4.095
"""The farthest the sensor measures, m."""

NEAREST = 0.02
"""The nearest the sensor measures, m."""

ACCURACY, RELATIVE_ACCURACY = 0.010, 0.01
"""Published accuracy: up to 1 m, in m; beyond, as a share of the distance."""

SIGMAS = 3.0
"""How many standard deviations the published accuracy is taken to be."""

RESOLUTION = 0.001
"""Of a reading, m."""


class Caster(Protocol):
    """Measures how far rays reach."""

    def cast(self, sensor: Pose) -> NDArray[np.float64]:
        """Return the distances from a sensor's pose, shape (n_rays,), m."""


MakeCaster = Callable[[Sequence[Box], NDArray[np.float64], float], Caster]


def ray_bearings(rays: int) -> NDArray[np.float64]:
    """Return the directions of a scan's rays in the chair's frame, from right to left, rad."""
    return np.linspace(-SPAN / 2, SPAN / 2, rays)


def deviation(distance: float) -> float:
    """Return the standard deviation of a reading, m.

    Examples
    --------
    >>> round(deviation(0.5), 5), round(deviation(3.0), 5)
    (0.00333, 0.01)
    """
    return max(ACCURACY, RELATIVE_ACCURACY * distance) / SIGMAS


class Laser:
    """A scanner on the chair.

    Parameters
    ----------
    boxes
        The obstacles; those that end below the laser are not seen.
    rays
        How many rays share the 239.4 degrees, at least 2.
    make_caster
        Called with boxes, bearings and reach; returns a ``Caster``.

    Attributes
    ----------
    bearings
        Shape (rays,): directions in the chair's frame, from right to left, rad.
    """

    bearings: NDArray[np.float64]

    def __init__(self, boxes: Sequence[Box], rays: int, make_caster: MakeCaster = RaySweep) -> None:
        seen = [box for box in boxes if box.height > LASER_HEIGHT]
        self.bearings = ray_bearings(rays)
        self._caster = make_caster(seen, self.bearings, REACH)
        self._shares = _segment_rays(self.bearings)

    def scan(
        self, sensor: Pose, rng: np.random.Generator
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Measure once.

        Parameters
        ----------
        sensor
            Where the sensor is.
        rng
            Its noise.

        Returns
        -------
        ranges : NDArray
            Shape (rays,): readings in m, in [0.02, 4].
        segments : NDArray
            Shape (15,): the nearest reading of each 12 degree segment of the front half circle,
            from right to left.
        """
        ranges = self._caster.cast(sensor)
        segments = np.empty(N_SEGMENTS)
        _measure(ranges, rng.standard_normal(len(ranges)), self._shares, segments)
        return ranges, segments


def _segment_rays(bearings: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return first and last-but-one ray of each segment; the nearest ray where it has none."""
    edges = np.linspace(-math.pi / 2, math.pi / 2, N_SEGMENTS + 1)
    bounds = np.searchsorted(bearings, edges - 1e-9)
    shares = np.stack([bounds[:-1], bounds[1:]], axis=1).astype(np.int64)
    for i in np.flatnonzero(shares[:, 0] == shares[:, 1]):
        middle = (edges[i] + edges[i + 1]) / 2
        nearest = int(np.argmin(np.abs(bearings - middle)))
        shares[i] = nearest, nearest + 1
    return shares


@compiled
def _measure(ranges: Any, normal: Any, shares: Any, segments: Any) -> None:
    """Turn distances into readings, and fill in each segment's nearest one."""
    for i in range(len(ranges)):
        sigma = max(ACCURACY, RELATIVE_ACCURACY * ranges[i]) / SIGMAS
        reading = RESOLUTION * round((ranges[i] + sigma * normal[i]) / RESOLUTION)
        ranges[i] = min(max(reading, NEAREST), LASER_RANGE)
    for i in range(len(shares)):
        segments[i] = ranges[shares[i, 0] : shares[i, 1]].min()
