"""Speedups: how much faster, as ratio of means and as mean of ratios."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from analysis.stats.bootstrap import RESAMPLES, bca_interval
from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, present_pairs

_BOOTSTRAP = f"BCa bootstrap over participants, {RESAMPLES:,} resamples"


def ratio_of_means(
    reference: Sample, condition: Sample, rng: np.random.Generator, level: float = 0.95
) -> TestResult:
    """Return mean(reference) / mean(condition): above 1 where the condition is faster.

    The paper's "speedup of 137%" is this quantity (76.7 s / 56.1 s).

    Parameters
    ----------
    reference, condition
        Times of the same participants in the same order, s; incomplete pairs are left out.
    rng
        For the bootstrap.
    level
        Confidence level of the interval.
    """
    return _ratio("ratio of means", _of_means, (reference, condition), rng, level)


def mean_of_ratios(
    reference: Sample, condition: Sample, rng: np.random.Generator, level: float = 0.95
) -> TestResult:
    """Return the mean over participants of reference / condition.

    Parameters
    ----------
    reference, condition
        Times of the same participants in the same order, s; incomplete pairs are left out.
    rng
        For the bootstrap.
    level
        Confidence level of the interval.
    """
    return _ratio("mean of ratios", _of_ratios, (reference, condition), rng, level)


def _ratio(
    name: str,
    statistic: Any,
    pair: tuple[Sample, Sample],
    rng: np.random.Generator,
    level: float,
) -> TestResult:
    reference, condition = present_pairs(*pair)
    if len(reference) == 0:
        return TestResult.missing(name, 0, "no pair is complete")
    low, high = bca_interval((reference, condition), statistic, rng, level)
    return TestResult(
        name=name,
        quantity="reference / condition",
        estimate=float(statistic(reference, condition)),
        low=low,
        high=high,
        level=level,
        n=len(reference),
        method=f"{name} of complete pairs; {_BOOTSTRAP}",
    )


def _of_means(a: NDArray[np.float64], b: NDArray[np.float64], axis: int = -1) -> Any:
    return a.mean(axis=axis) / b.mean(axis=axis)


def _of_ratios(a: NDArray[np.float64], b: NDArray[np.float64], axis: int = -1) -> Any:
    return (a / b).mean(axis=axis)
