"""How much practice alone would have to do to explain a difference."""

import math
from collections import Counter
from collections.abc import Sequence

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames
from analysis.order import part_of
from analysis.place import with_place
from analysis.roles import reference_condition
from analysis.stats.mixed_model import lap_time_design
from analysis.stats.result import TestResult

PLAUSIBLE = (0.0, 2.5, 5.0, 10.0, 15.0, 20.0)
"""Shares of the lap time that practice may save from one lap to the next, %."""


def order_confounded(frames: StudyFrames) -> bool:
    """Tell whether the lap's place in the session follows from its condition, or nearly so."""
    timed = frames.by_place.dropna(subset=["lap_time_s"])
    reference = reference_condition(frames.parts)
    if reference is None or timed["condition"].nunique() < 2:
        return False
    return not lap_time_design(with_place(timed), reference).with_place


def other_orders(frames: StudyFrames) -> tuple[int, int]:
    """Return how many participants drove the conditions in another order than most, and of all.

    A participant who left out laps of the common order has not driven another order.
    """
    laps = frames.laps.sort_values("lap")
    orders = [tuple(own["condition"]) for _, own in laps.groupby("participant", sort=True)]
    if not orders:
        return 0, 0
    ((common, _),) = Counter(orders).most_common(1)
    return sum(not part_of(order, common) for order in orders), len(orders)


def practice_table(frames: StudyFrames, model: Sequence[TestResult]) -> pd.DataFrame:
    """Return what is left of each difference if practice had done a plausible part of it.

    Practice is assumed to save the same share of the time from every lap to the next.

    Parameters
    ----------
    frames
        The study.
    model
        The contrasts, against the reference condition, as ``lap_time_model`` or ``own_contrasts``
        return them; those without an interval are left out.

    Returns
    -------
    DataFrame
        One row per contrast and assumed saving (``practice_percent`` per lap): ``laps_apart``,
        the remaining ``ratio`` of lap times with ``ratio_low`` and ``ratio_high``;
        ``explains_percent``, the saving per lap at which the interval would reach 1, and
        ``explains_all_percent``, at which the estimate would (NaN where practice works in the
        other direction). Empty where the order is not confounded.
    """
    columns = ["condition", "reference", "laps_apart", "practice_percent", "ratio", "ratio_low",
               "ratio_high", "explains_percent", "explains_all_percent"]  # fmt: skip
    rows: list[dict[str, object]] = []
    if order_confounded(frames):
        places = frames.by_place.groupby("condition")["lap"].mean()
        for contrast in model:
            condition, _, reference = contrast.name.partition(" against ")
            if math.isfinite(contrast.low):  # a contrast without an interval cannot be shifted
                apart = float(places[condition] - places[reference])
                rows += _rows(contrast, condition, reference, apart)
    return pd.DataFrame(rows, columns=columns)


def _rows(
    contrast: TestResult, condition: str, reference: str, apart: float
) -> list[dict[str, object]]:
    found = []
    for percent in PLAUSIBLE:
        saved = apart * math.log1p(-percent / 100)  # in log time; 0 or below for later laps
        ends = np.exp(np.array([contrast.estimate, contrast.low, contrast.high]) - saved)
        found.append(
            {
                "condition": condition,
                "reference": reference,
                "laps_apart": apart,
                "practice_percent": percent,
                "ratio": float(ends[0]),
                "ratio_low": float(ends[1]),
                "ratio_high": float(ends[2]),
                "explains_percent": _reaching(_nearer_end(contrast), contrast, apart),
                "explains_all_percent": _reaching(contrast.estimate, contrast, apart),
            }
        )
    return found


def _nearer_end(contrast: TestResult) -> float:
    return contrast.high if contrast.estimate < 0 else contrast.low


def _reaching(value: float, contrast: TestResult, apart: float) -> float:
    """Return the saving per lap, in %, at which a log ratio on the contrast's side reaches 0."""
    if apart == 0 or math.isnan(value):
        return math.nan
    if value * contrast.estimate <= 0:
        return 0.0
    per_lap = value / apart
    return 100 * -math.expm1(per_lap) if per_lap < 0 else math.nan
