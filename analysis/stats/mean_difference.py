"""The mean of paired differences, with the t interval and test."""

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, settled

_NAME = "mean difference"
_QUANTITY = "mean of condition minus reference"


def mean_difference(differences: Sample, level: float = 0.95) -> TestResult:
    """Return the mean of paired differences.

    Parameters
    ----------
    differences
        One per participant, condition minus reference; missing ones are left out.
    level
        Confidence level of the interval.

    Returns
    -------
    TestResult
        Without interval and p where the differences do not vary, or there is only one.

    Examples
    --------
    >>> result = mean_difference([1.0, 2.0, 3.0])
    >>> round(result.estimate, 2), round(result.p, 3)
    (2.0, 0.074)
    """
    d = settled(differences)
    if len(d) == 0:
        return TestResult.missing(_NAME, 0, "no pair is complete")
    if np.ptp(d) == 0:
        return _without_spread(d)
    mean, error = float(d.mean()), float(d.std(ddof=1)) / len(d) ** 0.5
    df = len(d) - 1
    half = float(stats.t.ppf((1 + level) / 2, df)) * error
    return TestResult(
        name=_NAME,
        quantity=_QUANTITY,
        estimate=mean,
        low=mean - half,
        high=mean + half,
        level=level,
        statistic=mean / error,
        statistic_name="t",
        p=float(2 * stats.t.sf(abs(mean / error), df)),
        n=len(d),
        method=f"paired t, {df} df, two-sided",
    )


def _without_spread(d: NDArray[np.float64]) -> TestResult:
    why = "one pair" if len(d) == 1 else "all differences are equal"
    return TestResult(
        name=_NAME,
        quantity=_QUANTITY,
        estimate=float(d[0]),
        n=len(d),
        method="mean of paired differences",
        notes=(f"{why}: no interval and no t test",),
    )
