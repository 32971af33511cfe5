"""A permutation test of paired differences: participants' signs are flipped."""

import itertools

import numpy as np
from numpy.typing import NDArray

from analysis.stats.mean_difference import mean_difference
from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, settled

EXACT_UP_TO = 14
"""Largest number of pairs for which every assignment of signs is tried."""

DRAWS = 9999

_NAME = "sign-flip permutation"


def sign_flip(differences: Sample, rng: np.random.Generator, level: float = 0.95) -> TestResult:
    """Test whether paired differences have mean zero, without assuming a distribution.

    Under the null hypothesis each participant's difference could as well have the other sign.

    Parameters
    ----------
    differences
        One per participant; missing ones are left out.
    rng
        For the signs, when there are too many pairs to try them all.
    level
        Confidence level of the interval, which is the t interval of the mean.

    Returns
    -------
    TestResult
        Estimate and statistic are the mean difference.

    References
    ----------
    Fisher (1935), The Design of Experiments, section 21.

    Examples
    --------
    >>> import numpy as np
    >>> sign_flip([1.0, 2.0, 3.0], np.random.default_rng(0)).p
    0.25
    """
    d = settled(differences)
    if len(d) < 2:
        return TestResult.missing(_NAME, len(d), "needs at least 2 pairs")
    if not d.any():
        return TestResult.missing(_NAME, len(d), "every difference is zero")
    exact = len(d) <= EXACT_UP_TO
    signs = _every_sign(len(d)) if exact else rng.choice([-1.0, 1.0], size=(DRAWS, len(d)))
    observed = abs(d.mean())
    as_large = np.abs(signs @ d) / len(d) >= observed * (1 - 1e-12)
    p = as_large.mean() if exact else (as_large.sum() + 1) / (DRAWS + 1)
    about = mean_difference(d, level)
    return TestResult(
        name=_NAME,
        quantity=about.quantity,
        estimate=float(d.mean()),
        low=about.low,
        high=about.high,
        level=level,
        statistic=float(d.mean()),
        statistic_name="mean",
        p=float(p),
        n=len(d),
        method=f"sign flips over participants, {'exact' if exact else f'{DRAWS} draws'}, "
        "two-sided; t interval",
    )


def _every_sign(n: int) -> NDArray[np.float64]:
    return np.array(list(itertools.product([-1.0, 1.0], repeat=n)))
