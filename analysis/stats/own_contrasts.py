"""Each participant's own contrast of log lap times, tested without a common spread."""

from dataclasses import replace

import numpy as np
import pandas as pd

from analysis.stats.mean_difference import mean_difference
from analysis.stats.result import TestResult


def own_contrasts(
    laps: pd.DataFrame, reference: str, level: float = 0.95
) -> tuple[TestResult, ...]:
    """Set every condition's log lap time against a reference's, within participants.

    The mixed model of ``analysis.stats.mixed_model`` takes the spread of all contrasts for one and
    the same. Where all people drive two conditions alike and a third differently, it is
    not, and the model's tests of the third reject too often. These do not: each contrast has its
    own standard deviation. With complete data both have the same estimate.

    Parameters
    ----------
    laps
        One row per lap: participant, condition, lap_time_s. Laps without a time are left out;
        several laps of a condition are averaged.
    reference
        The condition the others are set against.
    level
        Confidence level of the intervals.

    Returns
    -------
    tuple of TestResult
        One per condition, named as the model's: the estimate is the log of the ratio of geometric
        mean lap times, condition over reference, with the paired t interval and test.

    Examples
    --------
    >>> laps = pd.DataFrame({"participant": ["a", "a", "b", "b"], "condition": ["x", "y"] * 2,
    ...                      "lap_time_s": [50.0, 60.0, 40.0, 50.0]})
    >>> (found,) = own_contrasts(laps, "x")
    >>> found.name, round(float(np.exp(found.estimate)), 3)
    ('y against x', 1.225)
    """
    timed = laps.dropna(subset=["lap_time_s"])
    timed = timed.assign(log_time=np.log(timed["lap_time_s"].to_numpy(dtype=np.float64)))
    wide = timed.pivot_table(index="participant", columns="condition", values="log_time")
    if reference not in wide:
        return ()
    conditions = [c for c in dict.fromkeys(timed["condition"]) if c != reference]
    return tuple(_contrast(wide, c, reference, level) for c in conditions)


def _contrast(wide: pd.DataFrame, condition: str, reference: str, level: float) -> TestResult:
    differences = wide[condition] - wide[reference]
    found = mean_difference(differences, level)
    spread = float(differences.std())
    return replace(
        found,
        name=f"{condition} against {reference}",
        quantity="log of the ratio of lap times, condition / reference",
        checks=(f"standard deviation of the contrast {spread:.3g} (log s)",)
        if np.isfinite(spread)
        else (),
    )
