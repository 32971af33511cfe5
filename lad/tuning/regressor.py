"""The regressor's hyperparameters, by the exact marginal likelihood of what was demonstrated."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize

from lad.tuning.distances import Distances

Floats = NDArray[np.float64]

LEAST_NOISE = 1e-4
"""sigma_n^2 is not tuned below it: with less, K is singular in float64."""

REACH = 4.0
"""How far the logarithm of a hyperparameter may move from Table I's."""


@dataclass(frozen=True)
class Chosen:
    """Hyperparameters of the regressor, in the units of ``GPHyperparameters``."""

    signal_variance: float
    noise: float
    lengthscales: tuple[float, ...]
    constant_variance: float

    def logs(self) -> Floats:
        """Return the logarithms of those that are tuned; a constant of 0 stays 0."""
        values = [self.signal_variance, self.noise, *self.lengthscales]
        return np.log([*values, self.constant_variance] if self.constant_variance else values)

    @classmethod
    def from_logs(cls, logs: Floats, groups: int) -> "Chosen":
        """Turn ``logs`` back."""
        values = [float(v) for v in np.exp(logs)]
        constant = values[groups + 2] if len(values) > groups + 2 else 0.0
        return cls(values[0], values[1], tuple(values[2 : groups + 2]), constant)


def log_evidence(
    logs: Floats, distances: Distances, targets: Floats, squared_temporal_scale: float
) -> tuple[float, Floats]:
    """Return log p(Y | X) of the exact Gaussian process, and its gradient by ``logs``.

    Rasmussen & Williams (2006), equations 5.8 and 5.9, summed over the outputs, which share the
    kernel.

    Parameters
    ----------
    logs
        As ``Chosen.logs``.
    distances
        Of the windows in which help was given.
    targets
        Shape (n, p).
    squared_temporal_scale
        sigma_rho^2.
    """
    groups, (n, p) = distances.squared.shape[1], targets.shape
    at = Chosen.from_logs(logs, groups)
    kappa, slopes = distances.kappa(np.array(at.lengthscales), squared_temporal_scale)
    K = at.signal_variance * kappa + at.constant_variance + at.noise * np.eye(n)
    factor = cho_factor(K, lower=True)
    alpha = cho_solve(factor, targets)
    value = -0.5 * float(np.sum(targets * alpha)) - 0.5 * p * n * np.log(2.0 * np.pi)
    value -= p * float(np.log(np.diag(factor[0])).sum())
    inner = alpha @ alpha.T - p * cho_solve(factor, np.eye(n))
    gradient = [at.signal_variance * np.sum(inner * kappa), at.noise * np.trace(inner)]
    gradient += [at.signal_variance * np.sum(inner * slope) for slope in slopes]
    if at.constant_variance:
        gradient.append(at.constant_variance * np.sum(inner))
    return value, 0.5 * np.array(gradient)


def tune_regressor(
    start: Chosen, distances: Distances, targets: Floats, squared_temporal_scale: float
) -> Chosen:
    """Maximise the evidence times a log-normal prior around the start, sd 1.

    The result is rounded to three digits: the optimum is known no better, and the last bits of a
    factorisation depend on the number of threads.

    Parameters
    ----------
    start
        Where the search begins and the prior is centred: the study's own parameters.
    distances, targets, squared_temporal_scale
        As for ``log_evidence``.
    """
    centre = start.logs()
    groups = len(start.lengthscales)

    def loss(logs: Floats) -> tuple[float, Floats]:
        value, gradient = log_evidence(logs, distances, targets, squared_temporal_scale)
        off = logs - centre
        return -value + 0.5 * float(off @ off), -gradient + off

    bounds = [(c - REACH, c + REACH) for c in centre]
    bounds[1] = (max(bounds[1][0], float(np.log(LEAST_NOISE))), bounds[1][1])
    first = np.clip(centre, [low for low, _ in bounds], [high for _, high in bounds])
    found = minimize(loss, first, jac=True, method="L-BFGS-B", bounds=bounds)
    best = found.x if np.isfinite(found.fun) else centre
    at = Chosen.from_logs(best, groups)
    return Chosen(
        rounded(at.signal_variance),
        max(rounded(at.noise), LEAST_NOISE),
        tuple(rounded(size) for size in at.lengthscales),
        rounded(at.constant_variance),
    )


def rounded(value: float) -> float:
    """Round to three significant digits.

    Examples
    --------
    >>> rounded(0.0123456), rounded(0.0)
    (0.0123, 0.0)
    """
    return float(f"{value:.3g}")
