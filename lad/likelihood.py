"""What was observed, and what follows from it for the latent function.

The projected process needs only two numbers of a likelihood, the first and second derivative of
the log evidence with respect to the latent mean: q and r (Csato & Opper 2002, section 2).
"""

import math
from numbers import Real
from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfcx, ndtr

from lad.errors import HyperparameterError, InvalidTargetError
from lad.window import as_vector

LARGEST_TARGET = 1e50
SQRT_2 = math.sqrt(2.0)
SQRT_2_OVER_PI = math.sqrt(2.0 / math.pi)
LikelihoodName = Literal["gaussian", "probit"]
ProbabilityForm = Literal["probit", "paper"]


class Evidence(NamedTuple):
    """First and second derivative of the log evidence: q, one per output, and r, shared."""

    q: NDArray[np.float64]
    r: float


def check_outputs(likelihood: str, n_outputs: int) -> None:
    """Check that there is such a likelihood, and that it can have so many outputs.

    Raises
    ------
    HyperparameterError
        What was given and what is allowed.
    """
    allowed = get_args(LikelihoodName)
    if likelihood not in allowed:
        raise HyperparameterError(
            f"likelihood: given {likelihood!r}; allowed are {' and '.join(allowed)}"
        )
    if n_outputs < 1 or (likelihood == "probit" and n_outputs != 1):
        wanted = "1" if likelihood == "probit" else "1 or more"
        raise HyperparameterError(
            f"n_outputs: given {n_outputs} for {likelihood}; allowed is {wanted}"
        )


def check_target(y: object, n_outputs: int, likelihood: LikelihoodName) -> NDArray[np.float64]:
    """Check a target before anything changes.

    Parameters
    ----------
    y
        Shape (n_outputs,) of finite numbers (a plain number will do for one output); a label is
        exactly -1 or +1.
    n_outputs
        Number of outputs p.
    likelihood
        ``gaussian`` or ``probit``.

    Raises
    ------
    InvalidTargetError
        What was given and what is allowed.
    """
    if n_outputs == 1 and isinstance(y, Real) and not isinstance(y, bool):
        y = [y]
    target = as_vector(y, n_outputs, "target", InvalidTargetError)
    for value in target.tolist():
        if not -LARGEST_TARGET <= value <= LARGEST_TARGET:
            raise InvalidTargetError(
                f"target: given {value:g}; allowed are finite numbers up to {LARGEST_TARGET:g}"
            )
        if likelihood == "probit" and value not in (-1.0, 1.0):
            raise InvalidTargetError(f"label: given {value:g}; allowed are -1 and +1")
    return target


def gaussian_evidence(
    y: NDArray[np.float64], mean: NDArray[np.float64], variance: float
) -> Evidence:
    """Regression: q = (y - m) / v and r = -1 / v, with v the variance including noise."""
    return Evidence((y - mean) / variance, -1.0 / variance)


def probit_evidence(y: NDArray[np.float64], mean: NDArray[np.float64], variance: float) -> Evidence:
    """Classification: with s = sqrt(v), z = y m / s and h = phi(z) / Phi(z).

    q = y h / s and r = -h (z + h) / v. (The reference MATLAB code has -(z + h^2) / v, with which
    a variance can turn negative.) erfcx(x) = exp(x^2) erfc(x) gives h without the cancellation
    of log phi - log Phi, which loses digits as z^2 grows; h (z + h) lies in (0, 1).
    """
    s = math.sqrt(variance)
    z = float(y[0] * mean[0]) / s
    h = SQRT_2_OVER_PI / float(erfcx(-z / SQRT_2))
    return Evidence(y * (h / s), -min(max(h * (z + h), 0.0), 1.0) / variance)


def evidence(
    y: NDArray[np.float64],
    mean: NDArray[np.float64],
    variance: float,
    likelihood: LikelihoodName,
) -> Evidence:
    """Evidence of one target.

    Parameters
    ----------
    y
        Checked target, shape (p,).
    mean
        Predictive mean, shape (p,).
    variance
        Predictive variance including noise, positive.
    likelihood
        ``gaussian`` or ``probit``.
    """
    if likelihood == "gaussian":
        return gaussian_evidence(y, mean, variance)
    return probit_evidence(y, mean, variance)


def probability_of_help(
    mean: float, latent_variance: float, noise_variance: float, form: ProbabilityForm = "probit"
) -> float:
    """Probability that h = +1, from the classifier's latent mean and variance.

    Parameters
    ----------
    mean, latent_variance
        The classifier's prediction; the variance is positive and without noise.
    noise_variance
        sigma_n^2 of the classifier.
    form
        ``probit``, the predictive probability of the model, Phi(mu / sqrt(sigma^2 + noise)); or
        ``paper``, equation (10) of Soh & Demiris as it is printed, Phi(mu / sigma^2), with the
        latent variance of equation (9). The printed form has a unit inside Phi and grows too
        sure as the latent variance shrinks; it crosses 0.5 at the same inputs.

    Examples
    --------
    >>> probability_of_help(0.0, 0.1, 0.1)
    0.5
    >>> round(probability_of_help(0.2, 0.05, 0.1), 4)
    0.6972
    >>> round(probability_of_help(0.2, 0.05, 0.1, form="paper"), 4)
    1.0
    """
    if form == "paper":
        return float(ndtr(mean / latent_variance))
    return float(ndtr(mean / math.sqrt(latent_variance + noise_variance)))
