"""Ordinal regression of an item on condition, with a bootstrap over participants."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import special

from analysis.stats.bootstrap import FEWEST, why_no_interval
from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, present_pairs

RESAMPLES = 999
_NAME = "proportional odds"
_METHOD = "marginal proportional-odds regression (logit), maximum likelihood"
_BOOTSTRAP = f"percentile bootstrap over participants, {RESAMPLES} resamples"
_STEPS = 60
_LONGEST = 3.0
"""The most that a parameter changes in one step."""
_FAR = 12.0
"""A log odds ratio beyond this is taken for infinite: the answers are separated."""


def proportional_odds(
    condition: Sample, reference: Sample, rng: np.random.Generator, level: float = 0.95
) -> TestResult:
    """Return the log odds ratio of a higher answer after the condition.

    The ratio is marginal: over all people, not within a person, where it would be further from 1.
    Both answers of a participant count; because they belong together, the interval comes from
    resampling participants, and there is no p-value: the test of an item is Wilcoxon's.

    Parameters
    ----------
    condition, reference
        Answers of the same participants in the same order, whole numbers; incomplete pairs are
        left out.
    rng
        For the bootstrap.
    level
        Confidence level of the percentile interval.

    Returns
    -------
    TestResult
        An end of the interval may be infinite: then some resamples separate the two conditions.

    References
    ----------
    McCullagh (1980), J. Royal Statistical Society B 42(2), 109-142.

    Examples
    --------
    >>> import numpy as np
    >>> found = proportional_odds([4, 5, 4, 3, 5, 4], [2, 3, 3, 4, 2, 3], np.random.default_rng(0))
    >>> found.estimate > 0
    True
    """
    a, b = present_pairs(condition, reference)
    if len(a) < 2:
        return TestResult.missing(_NAME, len(a), "needs at least 2 pairs")
    points = np.unique(np.concatenate([a, b]))
    if len(points) < 2:
        return TestResult.missing(_NAME, len(a), "all answers are equal")
    answers = np.stack([np.searchsorted(points, b), np.searchsorted(points, a)])
    estimate = float(log_odds_ratios(_tables(answers, np.arange(len(a))[None], len(points)))[0])
    if math.isinf(estimate):
        return TestResult.missing(_NAME, len(a), "the answers after the two conditions separate")
    low, high = _interval(answers, len(points), rng, level)
    return TestResult(
        name=_NAME,
        quantity="marginal log odds ratio of a higher answer, condition / reference",
        estimate=estimate,
        low=low,
        high=high,
        level=level,
        n=len(a),
        method=_METHOD if math.isnan(low) else f"{_METHOD}; {_BOOTSTRAP}",
        checks=("proportional odds are assumed, not tested",),
        notes=why_no_interval((low, high), len(a)),
    )


def _interval(
    answers: NDArray[np.int64], points: int, rng: np.random.Generator, level: float
) -> tuple[float, float]:
    n = answers.shape[1]
    if n < FEWEST:
        return math.nan, math.nan
    drawn = rng.integers(n, size=(RESAMPLES, n))
    found = log_odds_ratios(_tables(answers, drawn, points))
    tails = [(1 - level) / 2, (1 + level) / 2]
    low, high = np.quantile(found, tails, method="inverted_cdf")
    return float(low), float(high)


def _tables(
    answers: NDArray[np.int64], drawn: NDArray[np.int64], points: int
) -> NDArray[np.float64]:
    """Return how often each answer was given: shape (resamples, 2, points)."""
    one_hot = answers[..., None] == np.arange(points)
    return np.asarray(one_hot[:, drawn].sum(axis=2).swapaxes(0, 1), dtype=np.float64)


def log_odds_ratios(tables: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the maximum-likelihood log odds ratio of each table.

    Parameters
    ----------
    tables
        Shape (tables, 2, points): counts of each answer in the reference (0) and condition (1).

    Returns
    -------
    NDArray
        Shape (tables,); infinite where the likelihood has no maximum, 0 where only one answer
        occurs.

    Examples
    --------
    >>> tables = np.array([[[10.0, 5.0], [5.0, 10.0]]])
    >>> np.exp(log_odds_ratios(tables)).round(3)  # (10 * 10) / (5 * 5)
    array([4.])
    """
    # Resamples of few people repeat each other: each different table is climbed once.
    different, where = np.unique(tables.reshape(len(tables), -1), axis=0, return_inverse=True)
    different = different.reshape(-1, *tables.shape[1:])
    found = np.zeros(len(different))
    occurs = different.sum(axis=1) > 0
    for pattern in np.unique(occurs, axis=0):
        if pattern.sum() > 1:  # an answer that never occurs has no threshold
            alike = (occurs == pattern).all(axis=1)
            found[alike] = _newton(different[alike][:, :, pattern])
    return found[where.ravel()]


def _newton(n: NDArray[np.float64]) -> NDArray[np.float64]:
    """Climb the concave likelihood of all tables at once; parameters are thresholds, then beta.

    A table that has arrived is left alone while the others climb.
    """
    k = n.shape[2]
    design = np.zeros((2 * (k - 1), k))
    design[: k - 1, : k - 1] = design[k - 1 :, : k - 1] = np.eye(k - 1)
    design[k - 1 :, -1] = -1.0
    share = np.cumsum(n.sum(axis=1), axis=1)[:, :-1] / n.sum(axis=(1, 2))[:, None]
    at = np.column_stack([special.logit(share), np.zeros(len(n))])
    height = _log_likelihood(at @ design.T, n)
    climbing = np.arange(len(n))
    for _ in range(_STEPS):
        at[climbing], height[climbing], step = _step(
            at[climbing], height[climbing], n[climbing], design
        )
        arrived = np.abs(step).max(axis=1) < 1e-10
        # Beyond this no single step leads back: the answers are separated.
        gone = np.abs(at[climbing, -1]) > _FAR + _LONGEST
        climbing = climbing[~(arrived | gone)]
        if not len(climbing):
            break
    beta = at[:, -1]
    return np.where(np.abs(beta) > _FAR, np.copysign(np.inf, beta), beta)


def _step(
    at: NDArray[np.float64],
    height: NDArray[np.float64],
    n: NDArray[np.float64],
    design: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return where one Newton step, halved until it does not lead down, arrives; and the step."""
    gradient, hessian = _slopes(at @ design.T, n)
    ridge = -1e-10 * np.eye(n.shape[2])
    step = np.linalg.solve(design.T @ hessian @ design + ridge, (gradient @ design)[..., None])
    step = np.clip(step[..., 0], -_LONGEST, _LONGEST)
    for _ in range(30):
        there = _log_likelihood((at - step) @ design.T, n)
        worse = ~(there >= height - 1e-12)
        if not worse.any():
            break
        step[worse] /= 2
    step[worse] = 0.0
    return at - step, np.where(worse, height, there), step


def _cells(
    e: NDArray[np.float64], shape: tuple[int, ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return cumulative probabilities (tables, 2, points - 1) and those of the single answers."""
    below = special.expit(e).reshape(shape[0], 2, shape[2] - 1)
    edges = np.concatenate([np.zeros((shape[0], 2, 1)), below, np.ones((shape[0], 2, 1))], axis=2)
    return below, np.diff(edges, axis=2)


def _log_likelihood(e: NDArray[np.float64], n: NDArray[np.float64]) -> NDArray[np.float64]:
    _, p = _cells(e, n.shape)
    with np.errstate(divide="ignore", invalid="ignore"):  # thresholds out of order: never accepted
        return np.asarray(special.xlogy(n, np.where(p > 0, p, 0.0)).sum(axis=(1, 2)))


def _slopes(
    e: NDArray[np.float64], n: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return gradient and Hessian of the log-likelihood by the linear predictors."""
    below, p = _cells(e, n.shape)
    p = np.maximum(p, 1e-100)
    f = below * (1 - below)
    pull, curve = n / p, n / p**2
    gradient = f * (pull[..., :-1] - pull[..., 1:])
    own = gradient * (1 - 2 * below) - f**2 * (curve[..., :-1] + curve[..., 1:])
    beside = f[..., :-1] * f[..., 1:] * curve[..., 1:-1]
    cuts = below.shape[2]
    hessian = np.zeros((len(n), 2 * cuts, 2 * cuts))
    for group in range(2):
        i = group * cuts + np.arange(cuts)
        hessian[:, i, i] = own[:, group]
        hessian[:, i[:-1], i[1:]] = hessian[:, i[1:], i[:-1]] = beside[:, group]
    return gradient.reshape(len(n), -1), hessian
