"""Whether two sources of assistance gave it in the same places."""

import itertools

import numpy as np
from numpy.typing import NDArray

from analysis.stats.bootstrap import FEWEST
from analysis.stats.result import TestResult

EXACT_UP_TO = 10
"""Largest number of participants for which every exchange is tried."""

DRAWS = 999

_NAME = "overlap of assistance maps"


def map_overlap(
    first: NDArray[np.float64],
    second: NDArray[np.float64],
    rng: np.random.Generator,
    level: float = 0.95,
) -> TestResult:
    """Compare two densities over the plan, with participants as the units.

    Under the null hypothesis the two sources are interchangeable within every participant; the
    p-value is the share of exchanges that overlap no more than the data.

    Parameters
    ----------
    first, second
        Shape (participants, cells): smoothed counts of either source's assisted steps. Row i of
        both belongs to one participant; participants whom either source never helped are left out.
    rng
        For exchanges and resamples.
    level
        Confidence level of the percentile bootstrap interval.

    Returns
    -------
    TestResult
        The estimate is the overlap coefficient, 0 (disjoint) to 1 (the same).

    References
    ----------
    Inman & Bradley (1989), Communications in Statistics 18(10), 3851-3874.
    """
    both = (first.sum(axis=1) > 0) & (second.sum(axis=1) > 0)
    cells = (first[both].sum(axis=0) > 0) | (second[both].sum(axis=0) > 0)
    f, g = first[both][:, cells], second[both][:, cells]
    n = int(both.sum())
    if n < 2:
        return TestResult.missing(_NAME, n, "needs 2 participants whom both sources helped")
    observed = float(_overlaps(f.sum(axis=0)[None], g.sum(axis=0)[None])[0])
    exact = n <= EXACT_UP_TO
    swaps = _every_swap(n) if exact else rng.integers(2, size=(DRAWS, n)).astype(np.float64)
    null = np.concatenate(
        [_overlaps((1 - s) @ f + s @ g, s @ f + (1 - s) @ g) for s in np.array_split(swaps, 16)]
    )
    fewer = null <= observed + 1e-12
    low, high = _interval(f, g, rng, level)
    return TestResult(
        name=_NAME,
        quantity="overlap coefficient",
        estimate=observed,
        low=low,
        high=high,
        level=level,
        statistic=observed,
        statistic_name="overlap",
        p=float(fewer.mean() if exact else (fewer.sum() + 1) / (DRAWS + 1)),
        n=n,
        method="sources exchanged within participants, "
        f"{'exact' if exact else f'{DRAWS} draws'}, one-sided (less overlap); percentile "
        f"bootstrap over participants, {DRAWS} resamples",
        notes=(f"{len(both) - n} participants without help from both left out",)
        if n < len(both)
        else (),
    )


def _overlaps(f: NDArray[np.float64], g: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the overlap of each row's two densities."""
    f = f / f.sum(axis=1, keepdims=True)
    g = g / g.sum(axis=1, keepdims=True)
    return np.asarray(np.minimum(f, g).sum(axis=1))


def _every_swap(n: int) -> NDArray[np.float64]:
    """Return every exchange; the first participant stays, since a full exchange changes nothing."""
    return np.array([(0.0, *rest) for rest in itertools.product([0.0, 1.0], repeat=n - 1)])


def _interval(
    f: NDArray[np.float64], g: NDArray[np.float64], rng: np.random.Generator, level: float
) -> tuple[float, float]:
    n = len(f)
    if n < FEWEST:
        return float("nan"), float("nan")
    weights = rng.multinomial(n, np.full(n, 1 / n), size=DRAWS).astype(np.float64)
    found = np.concatenate([_overlaps(w @ f, w @ g) for w in np.array_split(weights, 16)])
    low, high = np.quantile(found, [(1 - level) / 2, (1 + level) / 2])
    return float(low), float(high)
