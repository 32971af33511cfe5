"""A lap's place in the session: whether practice can be told from the conditions, and adjusting.

People get faster with every lap. Where each condition has had every place about equally often, that
averages out of a comparison; where it has not, part of a difference is practice.
"""

from typing import Literal

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from analysis.stats.mixed_model import lap_time_design, within_people

Practice = Literal["balanced", "adjusted", "confounded"]
"""What is done about practice in a comparison: log times without their place's mean; the place as a
factor of the mixed model; or nothing, as the place follows from the condition."""

BALANCED = 0.25
"""Largest share of laps that may be at places where the other condition's are not, so that place
counts as balanced. A Williams square of twelve that has lost two people is at 0.2 at most."""


def with_place(laps: pd.DataFrame) -> pd.DataFrame:
    """Return laps with their place among the participant's analysed laps, counted from 1.

    Parameters
    ----------
    laps
        participant and lap, practice laps left out; a recorded ``place`` is kept.
    """
    counted = laps.groupby("participant")["lap"].rank(method="dense")
    recorded = laps["place"] if "place" in laps else pd.Series(np.nan, index=laps.index)
    return laps.assign(place=recorded.astype("float64").fillna(counted))


def imbalance(laps: pd.DataFrame, condition: str, reference: str) -> float:
    """Return the share of a condition's laps at places where the reference's are not; 0 to 1.

    Parameters
    ----------
    laps
        participant, condition and place. Only people who drove both count.

    Examples
    --------
    >>> fixed = pd.DataFrame({"participant": ["a", "a", "b", "b"], "condition": ["x", "y"] * 2,
    ...                       "place": [1, 2, 1, 2]})
    >>> imbalance(fixed, "y", "x"), imbalance(fixed.assign(place=[1, 2, 2, 1]), "y", "x")
    (1.0, 0.0)
    """
    people, conditions = laps["participant"].to_numpy(), laps["condition"].to_numpy()
    drove = [set(people[conditions == c]) for c in (condition, reference)]
    both = np.isin(people, list(drove[0] & drove[1]))
    if not both.any():
        return 1.0
    levels, place = np.unique(laps["place"].to_numpy(), return_inverse=True)
    counts = [
        np.bincount(place[both & (conditions == c)], minlength=len(levels))
        for c in (condition, reference)
    ]
    shares = [count / count.sum() for count in counts]
    return round(float(np.abs(shares[0] - shares[1]).sum() / 2), 10)


def practice_of(laps: pd.DataFrame, condition: str, reference: str) -> Practice:
    """Return what can be done about practice in a comparison of two conditions.

    Parameters
    ----------
    laps
        Timed laps of all conditions: participant, condition, place.
    """
    if not {condition, reference} <= set(laps["condition"]):
        return "confounded"
    if not lap_time_design(laps, reference).with_place:
        return "confounded"
    return "balanced" if imbalance(laps, condition, reference) <= BALANCED else "adjusted"


def without_place(laps: pd.DataFrame, log_time: pd.Series) -> pd.Series:
    """Return log times less their place's effect, estimated beside people and conditions.

    In a balanced design that is each place's mean. Where places cannot be told from conditions,
    nothing is taken off.

    Parameters
    ----------
    laps
        participant, condition, place.
    log_time
        By the same index.
    """
    reference = str(laps["condition"].iloc[0])
    design = lap_time_design(laps, reference)
    if not design.with_place:
        return log_time
    first = 1 + len(design.contrasts)
    places = design.matrix[:, first:]
    columns = np.column_stack([design.matrix[:, 1:], log_time.to_numpy()])
    within = within_people(columns, laps["participant"])
    effects = np.linalg.lstsq(within[:, :-1], within[:, -1], rcond=None)[0][first - 1 :]
    adjusted: pd.Series = log_time - (places - places.mean(axis=0)) @ effects
    return adjusted


def less_places(laps: pd.DataFrame) -> tuple[int, int]:
    """Return the degrees of freedom within people, and how many of them the places take.

    Parameters
    ----------
    laps
        Timed laps: participant, condition, place.
    """
    design = lap_time_design(laps, str(laps["condition"].iloc[0]))
    contrasts = len(design.contrasts)
    within = len(laps) - laps["participant"].nunique() - contrasts
    return within, design.matrix.shape[1] - 1 - contrasts


def restored(
    differences: NDArray[np.float64], within: ArrayLike, taken: ArrayLike
) -> NDArray[np.float64]:
    """Return differences with the spread that the estimation of places has taken from them.

    Places estimated from the laps fit them too closely: what is left spreads less than it would
    with the true ones, and a signed-rank test rejects too often. As in a standard error, residuals
    are divided by the root of the share of degrees of freedom that is left; their mean stays. For
    pairs that have lost people or laps: in a whole square the test, which is discrete, keeps to its
    level without it (docs/analysis.md).

    Parameters
    ----------
    differences
        People along the last axis; NaN where missing.
    within, taken
        As ``less_places`` returns them, for each study where there are many.

    Examples
    --------
    >>> restored(np.array([0.0, 2.0, 4.0]), 4, 3)
    array([-2.,  2.,  6.])
    """
    left = np.asarray(within, dtype=np.float64) - np.asarray(taken, dtype=np.float64)
    share = np.divide(left, within, out=np.ones_like(left), where=left > 0)[..., None]
    there = np.isfinite(differences)
    count = np.maximum(there.sum(axis=-1, keepdims=True), 1)
    mean = np.where(there, differences, 0.0).sum(axis=-1, keepdims=True) / count
    return np.asarray(mean + (differences - mean) / np.sqrt(share))
