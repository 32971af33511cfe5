"""Bootstrap intervals over participants."""

import math
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

RESAMPLES = 1999
FEWEST = 6
"""With fewer participants a bootstrap interval is too narrow for its level."""

Statistic = Callable[..., NDArray[np.float64]]


def why_no_interval(interval: tuple[float, float], n: int) -> tuple[str, ...]:
    """Return the note that a bootstrap interval is missing, and why; nothing where there is one.

    Parameters
    ----------
    interval
        Its ends; NaN where there is none.
    n
        Participants.

    Examples
    --------
    >>> why_no_interval((float("nan"), float("nan")), 5)
    ('no bootstrap interval of fewer than 6 participants',)
    >>> why_no_interval((0.2, 0.9), 12)
    ()
    """
    if not any(map(math.isnan, interval)):
        return ()
    if n < FEWEST:
        return (f"no bootstrap interval of fewer than {FEWEST} participants",)
    return ("no bootstrap interval: leaving a participant out changes nothing",)


def bca_interval(
    samples: tuple[NDArray[Any], ...],
    statistic: Statistic,
    rng: np.random.Generator,
    level: float = 0.95,
) -> tuple[float, float]:
    """Return the bias-corrected and accelerated bootstrap interval of a statistic.

    Parameters
    ----------
    samples
        One or more arrays of equal length; entry i of each belongs to participant i, and
        participants are resampled whole.
    statistic
        Of ``*samples`` and ``axis``; vectorised.
    rng
        Where the resamples come from.
    level
        Confidence level.

    Returns
    -------
    tuple[float, float]
        NaN, NaN where there is none: fewer than six participants, or a statistic that does not
        vary when a participant is left out.

    References
    ----------
    Efron (1987), JASA 82(397), 171-185.

    Examples
    --------
    >>> sample = np.arange(10.0)
    >>> low, high = bca_interval((sample,), np.mean, np.random.default_rng(0))
    >>> bool(low < sample.mean() < high)
    True
    """
    if len(samples[0]) < FEWEST or all(np.ptp(sample) == 0 for sample in samples):
        return math.nan, math.nan
    with warnings.catch_warnings(), np.errstate(invalid="ignore", divide="ignore"):
        # The caller gets NaN instead: leaving one participant out changes nothing.
        warnings.simplefilter("ignore", stats.DegenerateDataWarning)
        interval = stats.bootstrap(
            samples,
            statistic,
            paired=len(samples) > 1,
            vectorized=True,
            n_resamples=RESAMPLES,
            batch=500,
            confidence_level=level,
            method="BCa",
            rng=rng,
        ).confidence_interval
    low, high = float(interval.low), float(interval.high)
    return (low, high) if math.isfinite(low) and math.isfinite(high) else (math.nan, math.nan)
