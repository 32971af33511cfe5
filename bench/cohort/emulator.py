"""What lap time a person with given traits would drive, learnt from some hundreds of pairs.

Two Gaussian processes on the logarithm of lap time, one for the baseline and one for the limited
lap. They make it cheap to ask what a whole population would do; their result is checked
against laps that are driven.
"""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import fields

import numpy as np
from numpy.typing import NDArray
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, DotProduct, WhiteKernel

from participants.population import TRAITS, Population
from participants.traits import Traits

Columns = Mapping[str, NDArray[np.float64]]
"""Traits of many people: one array for each trait."""

LOGARITHMS = (
    "preferred_speed_m_s", "lookahead_s", "reaction_delay_s", "stick_lag_s",
    "steering_gain_per_s", "motor_noise", "corner_deflection", "clearance_m",
)  # fmt: skip
"""Traits whose relative differences matter."""

AS_THEY_ARE = ("corner_speed_m_s", "lane_offset_m")


def draw_columns(population: Population, latent: NDArray[np.float64]) -> dict[str, NDArray]:
    """Return the traits of people by their latent variables, shape (people, traits)."""
    z = latent @ population.cholesky.T
    columns = {}
    for i, (name, trait) in enumerate(TRAITS.items()):
        marginal = population.marginals[name]
        share = (marginal.median - trait.low) / (trait.high - trait.low)
        logit = np.log(share / (1.0 - share)) + marginal.spread * z[:, i]
        columns[name] = trait.low + (trait.high - trait.low) / (1.0 + np.exp(-logit))
    return columns


def as_columns(people: Sequence[Traits]) -> dict[str, NDArray]:
    """Return people's traits as arrays."""
    return {f.name: np.array([getattr(p, f.name) for p in people]) for f in fields(Traits)}


def features(columns: Columns, lap: int) -> NDArray[np.float64]:
    """Return what a lap time depends on, shape (people, features)."""
    excess = columns["inexperience"] * (lap + 1.0) ** -columns["practice_exponent"]
    corner = excess * columns["corner_share"]
    parts = [np.log(columns[name]) for name in LOGARITHMS]
    parts += [columns[name] for name in AS_THEY_ARE]
    parts += [np.log1p(excess - corner), np.log1p(corner)]
    parts += [np.log1p(columns["corner_pause_s"] * corner)]
    if lap > 1:
        wondering = columns["limit_pause_s"] * (1.0 + 2.0 ** -columns["practice_exponent"])
        parts += [columns["limit_push"], np.log(columns["adaptation_per_s"]), np.log1p(wondering)]
    return np.column_stack(parts)


class LapTime:
    """One lap's time as learnt from driven ones.

    Parameters
    ----------
    columns
        Traits of the people who drove.
    seconds
        Shape (people,): their lap times.
    lap
        Position of the lap in the session.
    """

    def __init__(self, columns: Columns, seconds: NDArray[np.float64], lap: int) -> None:
        self._lap = lap
        x = features(columns, lap)
        self._middle, self._scale = x.mean(axis=0), x.std(axis=0)
        n = x.shape[1]
        smooth = ConstantKernel(0.1, (1e-4, 1e2)) * RBF(np.full(n, 3.0), (0.3, 100.0))
        kernel = DotProduct(1.0) * ConstantKernel(0.1, (1e-5, 1e2)) + smooth
        kernel += WhiteKernel(1e-3, (1e-6, 1e-1))
        self._gp = GaussianProcessRegressor(kernel, normalize_y=True, random_state=0)
        with warnings.catch_warnings():
            # A length at its upper bound says that the trait does not matter.
            warnings.simplefilter("ignore", ConvergenceWarning)
            self._gp.fit(self._scaled(x), np.log(seconds))

    @property
    def noise(self) -> float:
        """Standard deviation of a lap's logarithm that no trait explains."""
        white = self._gp.kernel_.k2.noise_level
        return float(np.sqrt(white) * self._gp._y_train_std)  # noqa: SLF001  # not public

    def log_seconds(self, columns: Columns) -> NDArray[np.float64]:
        """Return the expected logarithm of each person's lap time."""
        return np.asarray(self._gp.predict(self._scaled(features(columns, self._lap))))

    def _scaled(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        return (x - self._middle) / self._scale
