"""Whether two sources of assistance gave it in the same places."""

import itertools

import numpy as np
from numpy.typing import NDArray

from analysis.stats.result import TestResult

EXACT_UP_TO = 10
"""Largest number of participants for which every exchange is tried."""

DRAWS = 999

_NAME = "overlap of assistance maps"


def map_overlap(
    first: NDArray[np.float64], second: NDArray[np.float64], rng: np.random.Generator
) -> TestResult:
    """Compare two densities over the plan, with participants as the units.

    Under the null hypothesis the two sources are interchangeable within every participant; the
    p-value is the share of exchanges that overlap no more than the data. There is no interval: of
    few participants' maps the coefficient comes out too small, most of all where the true one is
    near 1, and resampling participants makes it smaller still. What exchanges give is noted
    instead: the range in which maps of one and the same source would lie.

    Parameters
    ----------
    first, second
        Shape (participants, cells): smoothed counts of either source's assisted steps. Row i of
        both belongs to one participant; participants without help from one of them are left out.
    rng
        For exchanges.

    Returns
    -------
    TestResult
        The estimate is the overlap coefficient, 0 (disjoint) to 1 (the same).

    References
    ----------
    Inman & Bradley (1989), Communications in Statistics 18(10), 3851-3874.
    """
    both = (first.sum(axis=1) > 0) & (second.sum(axis=1) > 0)
    rows = both[:, None]  # as a mask: a selection would copy maps of a thousand participants
    cells = (first.sum(axis=0, where=rows) > 0) | (second.sum(axis=0, where=rows) > 0)
    f, g = first[np.ix_(both, cells)], second[np.ix_(both, cells)]
    n = int(both.sum())
    if n < 2:
        return TestResult.missing(_NAME, n, "needs 2 participants with help from both sources")
    observed = float(_overlaps(f.sum(axis=0)[None], g.sum(axis=0)[None])[0])
    exact = n <= EXACT_UP_TO
    swaps = _every_swap(n) if exact else rng.integers(2, size=(DRAWS, n)).astype(np.float64)
    null = np.concatenate(
        [_overlaps((1 - s) @ f + s @ g, s @ f + (1 - s) @ g) for s in np.array_split(swaps, 16)]
    )
    fewer = null <= observed + 1e-12
    return TestResult(
        name=_NAME,
        quantity="overlap coefficient",
        estimate=observed,
        statistic=observed,
        statistic_name="overlap",
        p=float(fewer.mean() if exact else (fewer.sum() + 1) / (DRAWS + 1)),
        n=n,
        method="sources exchanged within participants, "
        f"{'exact' if exact else f'{DRAWS} draws'}, one-sided (less overlap)",
        notes=(_expected(null), *_left_out(len(both) - n)),
    )


def _expected(null: NDArray[np.float64]) -> str:
    low, high = np.quantile(null, [0.025, 0.975])
    return f"if the sources did not differ, 95% of overlaps would lie from {low:.2f} to {high:.2f}"


def _left_out(count: int) -> tuple[str, ...]:
    return (f"{count} participants without help from both left out",) if count else ()


def _overlaps(f: NDArray[np.float64], g: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the overlap of each row's two densities."""
    f = f / f.sum(axis=1, keepdims=True)
    g = g / g.sum(axis=1, keepdims=True)
    return np.asarray(np.minimum(f, g).sum(axis=1))


def _every_swap(n: int) -> NDArray[np.float64]:
    """Return every exchange; the first participant stays, since a full exchange changes nothing."""
    return np.array([(0.0, *rest) for rest in itertools.product([0.0, 1.0], repeat=n - 1)])
