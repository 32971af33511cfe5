"""Speedups: how much faster, as ratio of means and as mean of ratios."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from analysis.stats.mean_difference import mean_difference
from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, present_pairs

_QUANTITY = "reference / condition"


def ratio_of_means(reference: Sample, condition: Sample, level: float = 0.95) -> TestResult:
    """Return mean(reference) / mean(condition): above 1 where the condition is faster.

    The paper's "speedup of 137%" is this quantity (76.7 s / 56.1 s).

    Parameters
    ----------
    reference, condition
        Times of the same participants in the same order, s; incomplete pairs are left out.
    level
        Confidence level of Fieller's interval: the ratios r for which a paired t-test does not
        reject mean(reference) = r mean(condition).

    References
    ----------
    Fieller (1954), J. Royal Statistical Society B 16(2), 175-185.

    Examples
    --------
    >>> round(ratio_of_means([60.0, 80.0, 90.0], [50.0, 60.0, 75.0]).estimate, 3)
    1.243
    """
    name = "ratio of means"
    a, b = present_pairs(reference, condition)
    if len(a) == 0:
        return TestResult.missing(name, 0, "no pair is complete")
    low, high = _fieller(a, b, level) if len(a) > 1 else (math.nan, math.nan)
    return TestResult(
        name=name,
        quantity=_QUANTITY,
        estimate=float(a.mean() / b.mean()),
        low=low,
        high=high,
        level=level,
        n=len(a),
        method=_method("ratio of means of complete pairs", "Fieller interval", low),
    )


def mean_of_ratios(reference: Sample, condition: Sample, level: float = 0.95) -> TestResult:
    """Return the mean over participants of reference / condition.

    Parameters
    ----------
    reference, condition
        Times of the same participants in the same order, s, above 0; incomplete pairs are left
        out.
    level
        Confidence level of the t interval.

    Examples
    --------
    >>> round(mean_of_ratios([60.0, 80.0, 90.0], [50.0, 60.0, 75.0]).estimate, 3)
    1.244
    """
    name = "mean of ratios"
    a, b = present_pairs(reference, condition)
    if len(a) == 0:
        return TestResult.missing(name, 0, "no pair is complete")
    about = mean_difference(a / b, level)
    return TestResult(
        name=name,
        quantity=_QUANTITY,
        estimate=float((a / b).mean()),
        low=about.low,
        high=about.high,
        level=level,
        n=len(a),
        method=_method("mean of ratios of complete pairs", "t interval", about.low),
    )


def _method(estimate: str, interval: str, low: float) -> str:
    return f"{estimate}; {interval}" if math.isfinite(low) else estimate


def _fieller(a: NDArray[np.float64], b: NDArray[np.float64], level: float) -> tuple[float, float]:
    """Solve the quadratic of Fieller's theorem; NaN where the set of ratios has no two ends."""
    n = len(a)
    squared = float(stats.t.ppf((1 + level) / 2, n - 1)) ** 2 / n
    (s_aa, s_ab), (_, s_bb) = np.cov(a, b)
    square = b.mean() ** 2 - squared * s_bb
    middle = a.mean() * b.mean() - squared * s_ab
    constant = a.mean() ** 2 - squared * s_aa
    discriminant = middle**2 - square * constant
    if square <= 0 or discriminant <= 0:
        return math.nan, math.nan
    root = math.sqrt(discriminant)
    return float((middle - root) / square), float((middle + root) / square)
