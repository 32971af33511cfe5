"""Wilcoxon's signed-rank test, exact with ties and zeros too."""

import math
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, settled

Zeros = Literal["pratt", "wilcoxon"]

EXACT_UP_TO = 200
"""Largest number of non-zero differences for which the null distribution is enumerated."""

_NAME = "Wilcoxon signed-rank"


def signed_rank(differences: Sample, *, zeros: Zeros = "pratt", level: float = 0.95) -> TestResult:
    """Test whether paired differences are symmetric about zero.

    Ties get mid-ranks. Zeros either keep their ranks and are then dropped (Pratt) or are dropped
    before ranking (Wilcoxon). The null distribution is that of the ranks as they are, so the
    p-value is exact with ties as well.

    Parameters
    ----------
    differences
        One per participant, in any unit; missing ones are left out.
    zeros
        How differences of zero are treated.
    level
        Confidence level of the interval.

    Returns
    -------
    TestResult
        The estimate is the Hodges-Lehmann pseudomedian of the differences, the interval inverts
        the test without ties (conservative with them), the statistic is the sum of positive ranks.

    References
    ----------
    Pratt (1959), JASA 54(287), 655-667; Hollander, Wolfe & Chicken (2014), Nonparametric
    Statistical Methods, chapter 3.

    Examples
    --------
    >>> signed_rank([1.0, 2.0, 3.0, 4.0, 5.0]).p
    0.0625
    """
    given = settled(differences)
    kept, ranks = signed_ranks(given, zeros)
    if len(kept) == 0:
        why = "no pair is complete" if len(given) == 0 else "every difference is zero"
        return TestResult.missing(_NAME, len(given), why)
    positive = float(ranks[kept > 0].sum())
    exact = len(kept) <= EXACT_UP_TO
    low, high = _interval(given, level)
    return TestResult(
        name=_NAME,
        quantity="pseudomedian of the differences",
        estimate=float(np.median(_walsh(given))),
        low=low,
        high=high,
        level=level,
        statistic=positive,
        statistic_name="T+",
        p=_exact_p(ranks, positive) if exact else _normal_p(ranks, positive),
        n=len(given),
        method=f"Wilcoxon signed-rank, {'exact' if exact else 'normal approximation'}, two-sided; "
        f"mid-ranks for ties, zeros after {zeros.capitalize()}",
        notes=_notes(given, kept, low),
    )


def signed_ranks(
    differences: NDArray[np.float64], zeros: Zeros
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the non-zero differences and the ranks of their sizes.

    Parameters
    ----------
    differences
        Shape (pairs,): none of them missing.
    zeros
        Whether zeros are ranked and then dropped (``pratt``), or dropped first.

    Examples
    --------
    >>> signed_ranks(np.array([0.0, -2.0, 1.0]), "pratt")
    (array([-2.,  1.]), array([3., 2.]))
    """
    nonzero = differences != 0
    if zeros == "wilcoxon":
        kept = differences[nonzero]
        return kept, np.asarray(stats.rankdata(np.abs(kept)))
    ranks = np.asarray(stats.rankdata(np.abs(differences)))
    return differences[nonzero], ranks[nonzero]


def _exact_p(ranks: NDArray[np.float64], positive: float) -> float:
    """Two-sided p over all assignments of signs; mid-ranks are whole numbers when doubled."""
    doubled = np.rint(2 * ranks).astype(np.int64)
    pmf = np.zeros(int(doubled.sum()) + 1)
    pmf[0] = 1.0
    reached = 0
    for rank in doubled:
        moved = pmf[: reached + 1].copy()
        pmf[rank : rank + reached + 1] += moved
        pmf *= 0.5
        reached += int(rank)
    at = round(2 * positive)
    return float(min(1.0, 2 * min(pmf[: at + 1].sum(), pmf[at:].sum())))


def _normal_p(ranks: NDArray[np.float64], positive: float) -> float:
    z = (positive - ranks.sum() / 2) / math.sqrt((ranks**2).sum() / 4)
    return float(2 * stats.norm.sf(abs(z)))


def _walsh(differences: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the averages of all pairs, each with itself included, sorted."""
    i, j = np.triu_indices(len(differences))
    return np.sort((differences[i] + differences[j]) / 2)


def _interval(differences: NDArray[np.float64], level: float) -> tuple[float, float]:
    """Order statistics of the Walsh averages that the untied test would not reject."""
    n = len(differences)
    total = n * (n + 1) // 2
    if n <= EXACT_UP_TO:
        cut = _quantile(n, (1 - level) / 2)
    else:
        sd = math.sqrt(n * (n + 1) * (2 * n + 1) / 24)
        cut = round(total / 2 + float(stats.norm.ppf((1 - level) / 2)) * sd)
    if cut == 0:
        return math.nan, math.nan
    walsh = _walsh(differences)
    return float(walsh[cut - 1]), float(walsh[total - cut])


def _quantile(n: int, probability: float) -> int:
    """Smallest t with P(T <= t) at or above the probability; 0 when even t = 0 is too likely."""
    pmf = np.zeros(n * (n + 1) // 2 + 1)
    pmf[0] = 1.0
    for rank in range(1, n + 1):
        pmf[rank:] = pmf[rank:] + pmf[:-rank]
        pmf *= 0.5
    return int(np.searchsorted(np.cumsum(pmf), probability * (1 - 1e-12)))


def _notes(given: NDArray[np.float64], kept: NDArray[np.float64], low: float) -> tuple[str, ...]:
    notes = []
    if len(kept) < len(given):
        notes.append(f"{len(given) - len(kept)} of {len(given)} differences are zero")
    sizes, shared = np.unique(np.abs(kept), return_counts=True)
    if len(sizes) < len(kept):
        notes.append(f"{shared[shared > 1].sum()} of {len(given)} differences are tied")
    if math.isnan(low):
        pairs = "1 pair is" if len(given) == 1 else f"{len(given)} pairs are"
        notes.append(f"{pairs} too few for an interval of this level")
    return tuple(notes)
