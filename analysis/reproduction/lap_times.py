"""Lap times of the autonomous driver by condition (Figure 3)."""

import pandas as pd

from analysis.frames import StudyFrames
from analysis.outcomes import values
from analysis.stats.describe import describe
from analysis.stats.kolmogorov_smirnov import two_sample_ks
from analysis.stats.mean_difference import mean_difference
from analysis.stats.ratio import ratio_of_means
from analysis.stats.tost import paired_tost

MARGIN = 2.0
"""Difference of lap times that does not matter, s: what "statistically similar" should mean."""

LIMITED, DEMONSTRATOR = "limited", "demonstrator"


def lap_time_table(frames: StudyFrames) -> pd.DataFrame:
    """Return one row per condition; replicates are independent, and none is left out.

    Returns
    -------
    DataFrame
        ``condition``; ``n`` finished laps and ``unfinished`` ones; ``mean_s``, its 95% interval
        ``low_s`` to ``high_s``, ``sd_s``, ``median_s`` and ``longest_s``; ``takeovers`` per lap,
        mean; ``speedup_percent`` over the limited laps (ratio of
        means) with ``speedup_low`` and ``speedup_high``. Against the demonstrator's laps:
        ``behind_s`` with ``behind_low`` and ``behind_high``; ``ks`` and ``ks_p``, as the paper
        tested; the equivalence test's ``tost_low``, ``tost_high`` (90%) and ``tost_p``.
    """
    wide = frames.laps.pivot_table(
        index="participant", columns="condition", values="lap_time_s", aggfunc="mean", dropna=False
    ).astype("float64")
    return pd.DataFrame([_row(frames, wide, condition) for condition in frames.conditions])


def _row(frames: StudyFrames, wide: pd.DataFrame, condition: str) -> dict[str, object]:
    times = values(frames, "lap_time_s", condition)
    found, about = describe(times), mean_difference(times)
    speedup = ratio_of_means(wide[LIMITED], wide[condition])
    row: dict[str, object] = {
        "condition": condition,
        "n": found.n,
        "unfinished": found.missing,
        "mean_s": found.mean,
        "low_s": about.low,
        "high_s": about.high,
        "sd_s": found.sd,
        "median_s": found.median,
        "longest_s": found.high,
        "takeovers": describe(values(frames, "interventions", condition)).mean,
        "speedup_percent": 100 * speedup.estimate,
        "speedup_low": 100 * speedup.low,
        "speedup_high": 100 * speedup.high,
    }
    return {**row, **_against_demonstrator(frames, wide, condition)}


def _against_demonstrator(
    frames: StudyFrames, wide: pd.DataFrame, condition: str
) -> dict[str, float]:
    nothing = dict.fromkeys(
        ["behind_s", "behind_low", "behind_high", "ks", "ks_p", "tost_low", "tost_high", "tost_p"],
        float("nan"),
    )
    if condition == DEMONSTRATOR:
        return nothing
    difference = wide[condition] - wide[DEMONSTRATOR]
    about, same = mean_difference(difference), paired_tost(difference, MARGIN)
    ks = two_sample_ks(
        values(frames, "lap_time_s", condition),
        values(frames, "lap_time_s", DEMONSTRATOR),
        same_people=False,
    )
    return nothing | {
        "behind_s": describe(difference).mean,
        "behind_low": about.low,
        "behind_high": about.high,
        "ks": ks.estimate,
        "ks_p": ks.p,
        "tost_low": same.low,
        "tost_high": same.high,
        "tost_p": same.p,
    }
