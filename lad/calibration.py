"""Is p(h) worth believing? Brier score and reliability bins."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lad.errors import InvalidTargetError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Reliability:
    """Predicted against observed frequency of help, in bins of predicted probability.

    Attributes
    ----------
    edges
        Shape (bins + 1,): from 0 to 1; a bin includes its lower edge, the last also 1.
    count
        Shape (bins,): how many predictions fell into each bin.
    predicted
        Shape (bins,): mean predicted probability; NaN in an empty bin.
    observed
        Shape (bins,): share of steps with help; NaN in an empty bin.
    """

    edges: Floats
    count: NDArray[np.int64]
    predicted: Floats
    observed: Floats

    @property
    def expected_error(self) -> float:
        """Mean of |predicted - observed| over the predictions, in [0, 1]."""
        filled = self.count > 0
        gap = np.abs(self.predicted[filled] - self.observed[filled])
        return float(np.average(gap, weights=self.count[filled]))


def brier_score(p_help: Floats, helped: NDArray[np.bool_]) -> float:
    """Mean squared error of the probability of help: 0 is perfect, 0.25 is a constant 0.5.

    Parameters
    ----------
    p_help
        Shape (N,), in [0, 1].
    helped
        Shape (N,): whether help was given.

    Raises
    ------
    InvalidTargetError
        When there is nothing to score, shapes differ, or a probability is outside [0, 1].

    References
    ----------
    Brier, Verification of forecasts expressed in terms of probability, 1950 (one class's half of
    his two-class sum).

    Examples
    --------
    >>> brier_score(np.array([1.0, 0.5]), np.array([True, False]))
    0.125
    """
    p, h = _checked(p_help, helped)
    return float(np.mean((p - h) ** 2))


def reliability(p_help: Floats, helped: NDArray[np.bool_], n_bins: int = 10) -> Reliability:
    """Sort predictions into bins of equal width and compare them with what happened.

    Parameters
    ----------
    p_help
        Shape (N,), in [0, 1].
    helped
        Shape (N,): whether help was given.
    n_bins
        At least 1.

    Raises
    ------
    InvalidTargetError
        As ``brier_score``, or when there is no bin.

    Examples
    --------
    >>> bins = reliability(np.array([0.1, 0.2, 0.9]), np.array([False, True, True]), n_bins=2)
    >>> bins.count.tolist(), bins.observed.tolist()
    ([2, 1], [0.5, 1.0])
    """
    p, h = _checked(p_help, helped)
    if n_bins < 1:
        raise InvalidTargetError(f"n_bins: given {n_bins}; allowed is 1 or more")
    edges = np.linspace(0.0, 1.0, n_bins + 1)
    which = np.clip(np.searchsorted(edges, p, side="right") - 1, 0, n_bins - 1)
    count = np.bincount(which, minlength=n_bins)
    safe = np.where(count > 0, count, 1)
    empty = np.where(count > 0, 0.0, np.nan)
    return Reliability(
        edges=edges,
        count=count.astype(np.int64),
        predicted=np.bincount(which, weights=p, minlength=n_bins) / safe + empty,
        observed=np.bincount(which, weights=h, minlength=n_bins) / safe + empty,
    )


def _checked(p_help: Floats, helped: NDArray[np.bool_]) -> tuple[Floats, Floats]:
    p, h = np.asarray(p_help, dtype=np.float64), np.asarray(helped)
    if p.ndim != 1 or p.shape != h.shape or not p.size:
        raise InvalidTargetError(
            f"p_help and helped: given shapes {p.shape} and {h.shape}; "
            "allowed are two of the same length, 1 or more"
        )
    if not ((p >= 0.0) & (p <= 1.0)).all():
        raise InvalidTargetError("p_help: given a value outside [0, 1]; allowed are probabilities")
    if h.dtype != np.bool_:
        raise InvalidTargetError(f"helped: given dtype {h.dtype}; allowed is bool")
    return p, h.astype(np.float64)
