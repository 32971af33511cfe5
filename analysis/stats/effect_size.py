"""Effect sizes of paired differences, with bootstrap intervals over participants."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analysis.stats.bootstrap import FEWEST, RESAMPLES, bca_interval, why_no_interval
from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, settled

_BOOTSTRAP = f"BCa bootstrap over participants, {RESAMPLES:,} resamples"


def cohen_dz(differences: Sample, rng: np.random.Generator, level: float = 0.95) -> TestResult:
    """Return the mean difference in units of the differences' standard deviation.

    Parameters
    ----------
    differences
        One per participant; missing ones are left out.
    rng
        For the bootstrap.
    level
        Confidence level of the interval.

    References
    ----------
    Lakens (2013), Frontiers in Psychology 4, 863.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> round(cohen_dz(np.array([1.0, 2.0, 2.0, 3.0]), rng).estimate, 3)  # 2 / sd
    2.449
    """
    d = settled(differences)
    if len(d) < 2:
        return TestResult.missing("d_z", len(d), "needs at least 2 pairs")
    if np.ptp(d) == 0:
        return TestResult.missing("d_z", len(d), "all differences are equal")
    low, high = bca_interval((d,), _dz, rng, level)
    return TestResult(
        name="d_z",
        quantity="mean difference / sd of differences",
        estimate=float(_dz(d)),
        low=low,
        high=high,
        level=level,
        n=len(d),
        method=_method("Cohen's d for paired data (d_z)", low),
        notes=why_no_interval((low, high), len(d)),
    )


def rank_biserial(differences: Sample, rng: np.random.Generator, level: float = 0.95) -> TestResult:
    """Return the matched-pairs rank-biserial correlation, from -1 to 1.

    It is the share of signed-rank weight that is positive minus the share that is negative; zeros
    keep their ranks while ranking (Pratt) and count for neither side.

    Parameters
    ----------
    differences
        One per participant; missing ones are left out.
    rng
        For the bootstrap.
    level
        Confidence level of the interval.

    References
    ----------
    Kerby (2014), Comprehensive Psychology 3, 11.IT.3.1.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> rank_biserial(np.array([1.0, 2.0, -3.0, 4.0]), rng).estimate  # (7 - 3) / 10
    0.4
    """
    d = settled(differences)
    if len(d) == 0:
        return TestResult.missing("rank-biserial", 0, "no pair is complete")
    if not d.any():
        return TestResult.missing("rank-biserial", len(d), "every difference is zero")
    signed = _signed_levels(d)
    low, high = bca_interval((signed,), _rank_biserial, rng, level)
    return TestResult(
        name="rank-biserial",
        quantity="matched-pairs rank-biserial correlation",
        estimate=float(_rank_biserial(signed)),
        low=low,
        high=high,
        level=level,
        n=len(d),
        method=_method("matched-pairs rank-biserial correlation", low),
        notes=_about((low, high), d),
    )


def _method(effect: str, low: float) -> str:
    return f"{effect}; {_BOOTSTRAP}" if math.isfinite(low) else effect


def _about(interval: tuple[float, float], d: NDArray[np.float64]) -> tuple[str, ...]:
    if len(d) >= FEWEST and ((d >= 0).all() or (d <= 0).all()):
        return ("all differences have one sign: no bootstrap interval",)
    return why_no_interval(interval, len(d))


def _dz(d: NDArray[np.float64], axis: int = -1) -> Any:
    # A resample of one participant alone has no spread; its d_z is infinite in the mean's
    # direction, and percentiles take it as the extreme it is.
    return d.mean(axis=axis) / d.std(axis=axis, ddof=1)


def _signed_levels(d: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return which size each difference has among the different sizes, from 1, with its sign.

    Ranks follow from these as from the differences themselves; a zero is level 0.
    """
    sizes = np.unique(np.abs(d[d != 0]))
    return np.where(d == 0, 0, np.sign(d) * (1 + np.searchsorted(sizes, np.abs(d)))).astype(
        np.int64
    )


def _rank_biserial(signed: NDArray[np.int64], axis: int = -1) -> Any:
    # Resamples of answers have few sizes: counting them ranks every resample without sorting it.
    rows = np.moveaxis(signed, axis, -1)
    flat = rows.reshape(-1, rows.shape[-1])
    most = int(np.abs(flat).max(initial=0))
    width = 2 * most + 1
    cell = flat + (most + width * np.arange(len(flat)))[:, None]
    counts = np.bincount(cell.ravel(), minlength=width * len(flat)).reshape(-1, width)
    zeros, above, below = counts[:, most], counts[:, most + 1 :], counts[:, :most][:, ::-1]
    tied = above + below
    ranks = zeros[:, None] + np.cumsum(tied, axis=1) - (tied - 1) / 2  # of ties, their mean
    positive, negative = (ranks * above).sum(axis=1), (ranks * below).sum(axis=1)
    total = positive + negative
    share = np.divide(positive - negative, total, out=np.zeros_like(total), where=total > 0)
    return share.reshape(rows.shape[:-1])
