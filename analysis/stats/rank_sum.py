"""Wilcoxon's rank-sum test of two groups of people, exact whatever the ties."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, present

EXACT_UP_TO = 100
"""Most people in both groups together for which the null distribution is enumerated."""

_NAME = "Wilcoxon rank-sum"


def rank_sum(group: Sample, reference: Sample, level: float = 0.95) -> TestResult:
    """Test whether values of one group tend to be larger than another's.

    Ties get mid-ranks. The null distribution is that of the mid-ranks as they are.

    Parameters
    ----------
    group, reference
        One value per person; missing ones are left out.
    level
        Confidence level of the interval.

    Returns
    -------
    TestResult
        The estimate is the Hodges-Lehmann shift, the median of all differences between a person of
        the group and one of the reference; the interval inverts the test without ties.

    References
    ----------
    Mann & Whitney (1947), Annals of Mathematical Statistics 18(1), 50-60; Hollander, Wolfe &
    Chicken (2014), Nonparametric Statistical Methods, chapter 4.

    Examples
    --------
    >>> rank_sum([4.0, 5.0, 6.0], [1.0, 2.0, 3.0]).p
    0.1
    """
    a, b = present(group), present(reference)
    n = len(a) + len(b)
    if not len(a) or not len(b):
        return TestResult.missing(_NAME, n, "one of the groups is empty")
    both = np.concatenate([a, b])
    if np.ptp(both) == 0:
        return TestResult.missing(_NAME, n, "everybody has the same value")
    ranks = np.asarray(stats.rankdata(both))
    observed = float(ranks[: len(a)].sum())
    exact = n <= EXACT_UP_TO
    p = _exact_p(ranks, len(a), observed) if exact else _normal_p(ranks, len(a), observed)
    shifts = np.sort((a[:, None] - b[None]).ravel())
    low, high = _interval(shifts, len(a), len(b), level)
    return TestResult(
        name=_NAME,
        quantity="shift, group minus reference",
        estimate=float(np.median(shifts)),
        low=low,
        high=high,
        level=level,
        statistic=observed - len(a) * (len(a) + 1) / 2,
        statistic_name="U",
        p=p,
        n=n,
        method=f"Wilcoxon rank-sum, {'exact' if exact else 'normal approximation'}, two-sided; "
        "mid-ranks for ties",
        notes=() if math.isfinite(low) else ("too few people for an interval of this level",),
    )


def _exact_p(ranks: NDArray[np.float64], size: int, observed: float) -> float:
    """Two-sided p over all choices of who is in the group; mid-ranks are whole when doubled."""
    pmf = rank_sum_ways(np.rint(2 * ranks).astype(np.int64), size)
    at = round(2 * observed)
    return float(min(1.0, 2 * min(pmf[: at + 1].sum(), pmf[at:].sum())))


def rank_sum_ways(weights: NDArray[np.int64], size: int) -> NDArray[np.float64]:
    """Return the probability of every sum of ``size`` of the weights, drawn without replacement.

    Parameters
    ----------
    weights
        Whole ranks, or doubled mid-ranks; 1 or more.
    size
        How many are drawn.

    Returns
    -------
    NDArray
        By sum, from 0 on.

    Examples
    --------
    >>> rank_sum_ways(np.array([1, 2, 3]), 2)[3:6]  # 1 + 2, 1 + 3, 2 + 3
    array([0.33333333, 0.33333333, 0.33333333])
    """
    ways = np.zeros((size + 1, int(weights.sum()) + 1))
    ways[0, 0] = 1.0
    for i, weight in enumerate(weights):  # at most 100 choose 50, which a float holds
        for k in range(min(size, i + 1), 0, -1):
            ways[k, weight:] += ways[k - 1, : ways.shape[1] - weight]
    return np.asarray(ways[size] / ways[size].sum())


def _normal_p(ranks: NDArray[np.float64], size: int, observed: float) -> float:
    n = len(ranks)
    variance = size * (n - size) / n * float(ranks.var(ddof=1))
    return float(2 * stats.norm.sf(abs(observed - size * ranks.mean()) / math.sqrt(variance)))


def _interval(shifts: NDArray[np.float64], m: int, n: int, level: float) -> tuple[float, float]:
    """Order statistics of the differences that the untied test would not reject."""
    tail = (1 - level) / 2
    if m + n <= EXACT_UP_TO:
        pmf = rank_sum_ways(np.arange(1, m + n + 1), m)[m * (m + 1) // 2 :]
        cut = int(np.searchsorted(np.cumsum(pmf), tail * (1 - 1e-12)))
    else:
        sd = math.sqrt(m * n * (m + n + 1) / 12)
        cut = max(0, round(m * n / 2 + float(stats.norm.ppf(tail)) * sd))
    return (math.nan, math.nan) if cut == 0 else (float(shifts[cut - 1]), float(shifts[-cut]))
