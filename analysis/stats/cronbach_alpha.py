"""Reliability of a scale that is the mean of several items."""

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from analysis.stats.result import TestResult

_NAME = "Cronbach's alpha"


def cronbach_alpha(answers: ArrayLike, level: float = 0.95) -> TestResult:
    """Return Cronbach's alpha with Feldt's interval.

    Parameters
    ----------
    answers
        Shape (people, items), reverse-coded items turned; people with a missing answer are left
        out.
    level
        Confidence level of the interval.

    References
    ----------
    Cronbach (1951), Psychometrika 16(3), 297-334; Feldt (1965), Psychometrika 30(3), 357-370.

    Examples
    --------
    >>> round(cronbach_alpha([[1, 2], [2, 2], [3, 4], [4, 4], [5, 5]]).estimate, 3)
    0.964
    """
    table = np.atleast_2d(np.asarray(answers, dtype=np.float64))
    complete = table[np.isfinite(table).all(axis=1)]
    n, k = complete.shape
    if k < 2:
        return TestResult.missing(_NAME, n, "a scale needs at least 2 items")
    if n < 3:
        return TestResult.missing(_NAME, n, "needs at least 3 complete answer sheets")
    total = float(complete.sum(axis=1).var(ddof=1))
    if total == 0:
        return TestResult.missing(_NAME, n, "all people have the same score")
    alpha = k / (k - 1) * (1 - float(complete.var(axis=0, ddof=1).sum()) / total)
    df = (n - 1, (n - 1) * (k - 1))
    tails = np.asarray(stats.f.ppf([(1 + level) / 2, (1 - level) / 2], *df))
    low, high = (1 - (1 - alpha) * float(f) for f in tails)
    left_out = len(table) - n
    return TestResult(
        name=_NAME,
        quantity="reliability of the mean of the items",
        estimate=alpha,
        low=low,
        high=high,
        level=level,
        n=n,
        method=f"Cronbach's alpha of {k} items, Feldt interval",
        notes=(f"{left_out} incomplete answer sheets left out",) if left_out else (),
    )
