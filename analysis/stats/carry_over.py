"""First-order carry-over: how much the condition before changes the next lap."""

from dataclasses import replace

import numpy as np
import pandas as pd

from analysis.stats.mixed_model import indicator, inflation, lap_time_design, model_result
from analysis.stats.random_intercept import fit_random_intercept
from analysis.stats.result import TestResult

INFLATED = 5.0
"""As in ``analysis.stats.mixed_model``: carry-over that inflates a contrast more is not told apart
from the conditions."""


def carry_over(laps: pd.DataFrame, reference: str, level: float = 0.95) -> tuple[TestResult, ...]:
    """Estimate what a lap owes to the condition of the lap before.

    Parameters
    ----------
    laps
        One row per lap: participant, condition, place, lap_time_s. Laps without a time are left
        out, but count as the lap before.
    reference
        The condition before which the others are set against.
    level
        Confidence level of the intervals.

    Returns
    -------
    tuple of TestResult
        One per condition before: the log of the ratio of lap times, after it / after the
        reference, in the mixed model with conditions and places. Empty where the design does not
        identify it: a fixed order never does, a Williams square does.

    References
    ----------
    Williams (1949), Australian J. of Scientific Research A 2(2), 149-168.
    """
    ordered = laps.sort_values(["participant", "place"])
    before = ordered.groupby("participant")["condition"].shift().fillna("")
    timed = ordered.assign(before=before).dropna(subset=["lap_time_s"])
    if reference not in set(timed["condition"]) or timed["condition"].nunique() < 2:
        return ()
    design = lap_time_design(timed, reference)
    earlier = [c for c in dict.fromkeys(timed["before"]) if c not in ("", reference)]
    # Of a first lap nothing is carried over: it has the mean of all carry-over effects, which the
    # places take up.
    first = indicator(timed["before"], "")[:, None] / (len(earlier) + 1)
    columns = np.column_stack([indicator(timed["before"], c) for c in earlier] or [first[:, 0]])
    wider = np.column_stack([design.matrix, columns + first])
    if not design.with_place or not earlier:
        return ()
    if inflation(design.matrix, wider, timed["participant"]) >= INFLATED:
        return ()
    log_time = np.log(timed["lap_time_s"].to_numpy(dtype=np.float64))
    fit = fit_random_intercept(log_time, wider, timed["participant"])
    if fit is None:
        return ()
    n = int(timed["participant"].nunique())
    found = []
    for i, condition in enumerate(earlier):
        weights = np.zeros(wider.shape[1])
        weights[design.matrix.shape[1] + i] = 1.0
        formula = "condition + place + condition before"
        tested = model_result(fit, weights, n=n, level=level, formula=formula)
        name = f"after {condition} against after {reference}"
        quantity = "log of the ratio of lap times, after it / after the reference"
        found.append(replace(tested, name=name, quantity=quantity))
    return tuple(found)
