"""The declared tests on many studies at once: rows are studies, columns are people."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from analysis.stats.rank_sum import rank_sum, rank_sum_ways
from analysis.stats.signed_rank import signed_rank

Rows = NDArray[np.float64]


def signed_rank_p(differences: Rows) -> NDArray[np.float64]:
    """Return Wilcoxon's exact two-sided p of each row; missing values are NaN.

    Rows with ties, zeros or missing values go through ``signed_rank`` one by one.

    Examples
    --------
    >>> signed_rank_p(np.array([[1.0, 2.0, 3.0, 4.0, 5.0]]))
    array([0.0625])
    """
    sizes = np.sort(np.abs(differences), axis=1)
    plain = (np.diff(sizes, axis=1) > 0).all(axis=1) & (sizes[:, 0] > 0)
    plain &= np.isfinite(differences).all(axis=1)
    found = np.empty(len(differences))
    for i in np.flatnonzero(~plain):
        tested = signed_rank(differences[i])
        found[i] = tested.p if tested.computed else np.nan
    rows = differences[plain]
    if len(rows):
        ranks = np.argsort(np.argsort(np.abs(rows), axis=1), axis=1) + 1
        positive = (ranks * (rows > 0)).sum(axis=1)
        found[plain] = _null(rows.shape[1])[positive]
    return found


@lru_cache(maxsize=128)
def _null(n: int) -> NDArray[np.float64]:
    """Return the two-sided p of every sum of positive ranks of n untied differences."""
    pmf = np.zeros(n * (n + 1) // 2 + 1)
    pmf[0] = 1.0
    for rank in range(1, n + 1):
        pmf[rank:] = pmf[rank:] + pmf[:-rank]
        pmf *= 0.5
    below = np.cumsum(pmf)
    above = np.cumsum(pmf[::-1])[::-1]
    return np.asarray(np.minimum(1.0, 2 * np.minimum(below, above)))


def paired_t_p(differences: Rows) -> NDArray[np.float64]:
    """Return the two-sided p of a paired t-test of each row."""
    mean, error, df = _moments(differences)
    return np.asarray(2 * stats.t.sf(np.abs(mean / error), df))


def tost_p(differences: Rows, margin: float) -> NDArray[np.float64]:
    """Return the p of two one-sided paired t-tests of each row."""
    mean, error, df = _moments(differences)
    lower, upper = stats.t.sf((mean + margin) / error, df), stats.t.cdf((mean - margin) / error, df)
    return np.asarray(np.maximum(lower, upper))


def _moments(differences: Rows) -> tuple[Rows, Rows, Rows]:
    n = np.isfinite(differences).sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.nansum(differences, axis=1) / n
        spread = np.nansum((differences - mean[:, None]) ** 2, axis=1) / (n - 1)
        return mean, np.sqrt(spread / n), (n - 1).astype(np.float64)


def pseudomedians(differences: Rows, level: float = 0.95) -> tuple[Rows, Rows]:
    """Return each row's Hodges-Lehmann estimate, and the width of its interval.

    The interval's order statistics are those of untied differences of everyone; a row with missing
    values takes them from those it has.
    """
    estimates, widths = np.full((2, len(differences)), np.nan)
    there = np.isfinite(differences).sum(axis=1)
    for n in np.unique(there[there > 1]):
        chosen = np.flatnonzero(there == n)
        rows = np.sort(differences[chosen], axis=1)[:, :n]  # NaN sorts last
        i, j = np.triu_indices(n)
        walsh = np.sort((rows[:, i] + rows[:, j]) / 2, axis=1)
        estimates[chosen] = np.median(walsh, axis=1)
        cut = int(np.searchsorted(_lower_tail(int(n)), (1 - level) / 2 * (1 - 1e-12)))
        if cut:
            widths[chosen] = walsh[:, -cut] - walsh[:, cut - 1]
    return estimates, widths


@lru_cache(maxsize=128)
def _lower_tail(n: int) -> NDArray[np.float64]:
    two_sided = _null(n) / 2
    half = len(two_sided) // 2
    return np.concatenate([two_sided[:half], np.ones(1)])


def rank_sum_rows(first: Rows, second: Rows) -> tuple[Rows, Rows, Rows]:
    """Return p, Hodges-Lehmann shift and the width of its interval for two groups' rows.

    Missing values are NaN. Rows with ties go through ``rank_sum`` one by one.

    Examples
    --------
    >>> p, shift, _ = rank_sum_rows(np.array([[4.0, 5.0, 6.0]]), np.array([[1.0, 2.0, 3.0]]))
    >>> float(p[0]), float(shift[0])
    (0.1, 3.0)
    """
    p, shift, width = np.full((3, len(first)), np.nan)
    sizes = np.stack([np.isfinite(first).sum(axis=1), np.isfinite(second).sum(axis=1)], axis=1)
    for m, n in np.unique(sizes, axis=0):
        chosen = np.flatnonzero((sizes == (m, n)).all(axis=1))
        if m == 0 or n == 0:
            continue
        a, b = np.sort(first[chosen], axis=1)[:, :m], np.sort(second[chosen], axis=1)[:, :n]
        shifts = np.sort((a[:, :, None] - b[:, None, :]).reshape(len(chosen), -1), axis=1)
        below, cut = _rank_sum_null(int(m), int(n))
        tail = below[(shifts > 0).sum(axis=1)], below[(shifts < 0).sum(axis=1)]
        p[chosen] = np.minimum(1.0, 2 * np.minimum(*tail))
        shift[chosen] = np.median(shifts, axis=1)
        if cut:
            width[chosen] = shifts[:, -cut] - shifts[:, cut - 1]
    for i in np.flatnonzero(_tied(np.concatenate([first, second], axis=1))):
        tested = rank_sum(first[i], second[i])
        p[i] = tested.p if tested.computed else np.nan
    return p, shift, width


def _tied(rows: Rows) -> NDArray[np.bool_]:
    return np.asarray((np.diff(np.sort(rows, axis=1), axis=1) == 0).any(axis=1))


@lru_cache(maxsize=512)
def _rank_sum_null(m: int, n: int, level: float = 0.95) -> tuple[NDArray[np.float64], int]:
    """Return the probability of U at most each value, and which order statistics bound a shift."""
    below = np.cumsum(rank_sum_ways(np.arange(1, m + n + 1), m)[m * (m + 1) // 2 :])
    return below, int(np.searchsorted(below, (1 - level) / 2 * (1 - 1e-12)))
