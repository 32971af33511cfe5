"""The classifier's signal variance, by Laplace's approximation of the evidence; nothing else of it.

Its lengthscales are not tuned. Maximising the likelihood over them makes the probabilities better
and the laps worse: it learns "the chair already turns as fast as only help turns it", which is
true of every demonstrated step and of no step before help begins (docs/learning.md).
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve, cholesky
from scipy.optimize import minimize_scalar
from scipy.special import log_ndtr, ndtri

from lad.tuning.regressor import REACH, rounded

Floats = NDArray[np.float64]

MOST_STEPS = 50
CLOSE = 1e-8


def log_evidence(
    signal_variance: float, kappa: Floats, labels: Floats, noise: float, prior_help: float
) -> float:
    """Return Laplace's approximation of log p(h | X), Rasmussen & Williams (2006), 3.32.

    Parameters
    ----------
    signal_variance
        sigma_f^2.
    kappa
        Shape (n, n), equation (7).
    labels
        Shape (n,): -1 or +1.
    noise
        sigma_n^2 in latent units: p(h | f) = Phi(h f / sigma_n).
    prior_help
        pi; the latent mean is m0 = Phi^-1(pi) sqrt(sigma_f^2 + sigma_n^2).
    """
    K = signal_variance * kappa
    m0 = float(ndtri(prior_help)) * np.sqrt(signal_variance + noise)
    sd = np.sqrt(noise)
    a = np.zeros(len(labels))  # f = m0 + K a, so that f' K^-1 f needs no inverse

    def objective(a: Floats) -> float:
        g = K @ a
        return float(log_ndtr(labels * (m0 + g) / sd).sum() - 0.5 * a @ g)

    value = objective(a)
    for _ in range(MOST_STEPS):
        z = labels * (m0 + K @ a) / sd
        h = np.exp(-0.5 * z * z - 0.5 * np.log(2.0 * np.pi) - log_ndtr(z))
        slope, weight = labels * h / sd, h * (z + h) / noise
        root = np.sqrt(weight)
        L = cholesky(np.eye(len(z)) + root[:, None] * K * root[None, :], lower=True)
        b = weight * (K @ a) + slope
        towards = b - root * cho_solve((L, True), root * (K @ b)) - a
        size = 1.0
        while objective(a + size * towards) < value and size > 1e-6:
            size *= 0.5
        a = a + size * towards
        gained, value = objective(a) - value, objective(a)
        if gained < CLOSE:
            break
    return value - float(np.log(np.diag(L)).sum())


def tune_signal_variance(
    start: float, kappa: Floats, labels: Floats, noise: float, prior_help: float
) -> float:
    """Maximise the evidence times a log-normal prior around the start, sd 1; three digits."""

    def loss(log_variance: float) -> float:
        off = log_variance - np.log(start)
        found = log_evidence(float(np.exp(log_variance)), kappa, labels, noise, prior_help)
        return float(-found + 0.5 * off * off)

    middle = float(np.log(start))
    found = minimize_scalar(
        loss, bounds=(middle - REACH, middle + REACH), method="bounded", options={"xatol": 1e-3}
    )
    return rounded(float(np.exp(found.x)))
