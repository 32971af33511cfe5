"""Equivalence of paired measurements: two one-sided tests."""

import numpy as np
from scipy import stats

from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, settled

_NAME = "equivalence (TOST)"

SKEWED = 1.0
"""Skewness from which it is said that the test does not keep its level; twelve normal differences
reach it in 7% of all studies."""


def paired_tost(differences: Sample, margin: float, alpha: float = 0.05) -> TestResult:
    """Test whether a mean paired difference lies within a margin of zero.

    Parameters
    ----------
    differences
        One per participant; missing ones are left out.
    margin
        Largest difference that does not matter, in the unit of the differences; above 0.
    alpha
        Level of either one-sided test.

    Returns
    -------
    TestResult
        The estimate is the mean difference, the interval has level 1 - 2 alpha, and the p-value is
        the larger of the two one-sided ones: below alpha, the conditions are equivalent.

    Raises
    ------
    ValueError
        When the margin is not above 0.

    References
    ----------
    Schuirmann (1987), J. Pharmacokinetics and Biopharmaceutics 15(6), 657-680.

    Examples
    --------
    >>> paired_tost([-0.5, 0.2, 0.1, -0.1, 0.3], margin=5.0).p < 0.001
    True
    """
    if not margin > 0:
        raise ValueError(f"margin: {margin} is out of range; allowed: above 0")
    d = settled(differences)
    if len(d) < 2:
        return TestResult.missing(_NAME, len(d), "needs at least 2 pairs")
    if np.ptp(d) == 0:
        return TestResult.missing(_NAME, len(d), "all differences are equal")
    df = len(d) - 1
    mean, error = float(d.mean()), float(d.std(ddof=1)) / len(d) ** 0.5
    above_lower, below_upper = (mean + margin) / error, (mean - margin) / error
    p = max(float(stats.t.sf(above_lower, df)), float(stats.t.cdf(below_upper, df)))
    half = float(stats.t.ppf(1 - alpha, df)) * error
    skewness = float(stats.skew(d))
    skewed = (
        f"the differences are skewed ({skewness:.1f}): t-tests of few people then call conditions "
        "alike too often where the true difference is on the side of the long tail"
    )
    return TestResult(
        name=_NAME,
        quantity="mean difference",
        estimate=mean,
        low=mean - half,
        high=mean + half,
        level=1 - 2 * alpha,
        statistic=min(above_lower, -below_upper),
        statistic_name="t",
        p=p,
        n=len(d),
        method=f"two one-sided paired t-tests, margin {margin:g}, larger p; t on {df} df",
        checks=(f"skewness of the differences {skewness:.2f}",),
        notes=(skewed,) if abs(skewness) > SKEWED else (),
    )
