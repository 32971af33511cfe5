"""The mean of paired differences, with the t interval and test."""

import numpy as np
from scipy import stats

from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, present

_NAME = "mean difference"


def mean_difference(differences: Sample, level: float = 0.95) -> TestResult:
    """Return the mean of paired differences.

    Parameters
    ----------
    differences
        One per participant, condition minus reference; missing ones are left out.
    level
        Confidence level of the interval.

    Examples
    --------
    >>> result = mean_difference([1.0, 2.0, 3.0])
    >>> round(result.estimate, 2), round(result.p, 3)
    (2.0, 0.074)
    """
    d = present(differences)
    if len(d) < 2:
        return TestResult.missing(_NAME, len(d), "needs at least 2 pairs")
    mean, error = float(d.mean()), float(d.std(ddof=1)) / len(d) ** 0.5
    if np.ptp(d) == 0:
        return TestResult.missing(_NAME, len(d), f"all differences are equal ({mean:g})")
    df = len(d) - 1
    half = float(stats.t.ppf((1 + level) / 2, df)) * error
    return TestResult(
        name=_NAME,
        quantity="mean of condition minus reference",
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
