"""Lap times by course, and how often the model helps in which kind of section."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from analysis.reproduction.generalisation.evidence import Elsewhere
from analysis.stats.describe import describe
from analysis.stats.mean_difference import mean_difference

CONDITIONS = ("baseline", "limited", "demonstrator", "model")


def course_table(courses: Sequence[Elsewhere]) -> pd.DataFrame:
    """Return one row per course and condition.

    Returns
    -------
    DataFrame
        ``course``, ``condition``, ``n`` laps and how many of them are ``unfinished``, ``mean_s``
        with its 95% interval ``low_s`` to ``high_s``, ``sd_s``, ``median_s``; of the model's
        laps, replicate by replicate: ``over_limited_s`` and ``over_demonstrator_s`` with ``_low``
        and ``_high``.
    """
    return pd.DataFrame([_row(c, condition) for c in courses for condition in CONDITIONS])


def section_table(courses: Sequence[Elsewhere]) -> pd.DataFrame:
    """Return one row per course and kind of section.

    Returns
    -------
    DataFrame
        ``course``, ``kind``, ``n`` replicates; ``assisted``, the mean share of steps in which the
        model helped, with its 95% interval ``low`` to ``high``; ``would``, the share in which the
        demonstrator would have.
    """
    return pd.DataFrame([_shares(c, kind) for c in courses for kind in c.kinds])


def _row(course: Elsewhere, condition: str) -> dict[str, object]:
    times = course.laps[condition]
    d, about = describe(times), mean_difference(times)
    row: dict[str, object] = {
        "course": course.course,
        "condition": condition,
        "n": d.n,
        "unfinished": int((~course.finished[condition]).sum()),
        "mean_s": d.mean,
        "low_s": about.low,
        "high_s": about.high,
        "sd_s": d.sd,
        "median_s": d.median,
    }
    for reference in ("limited", "demonstrator"):
        found = mean_difference(times - course.laps[reference]) if condition == "model" else None
        ends = (found.estimate, found.low, found.high) if found else (np.nan,) * 3
        names = (f"over_{reference}_s", f"over_{reference}_low", f"over_{reference}_high")
        row |= dict(zip(names, ends, strict=True))
    return row


def _shares(course: Elsewhere, kind: str) -> dict[str, object]:
    here = course.shares[course.shares["kind"] == kind]
    low, high = _interval(here["assisted"])
    return {
        "course": course.course,
        "kind": kind,
        "n": len(here),
        "assisted": float(here["assisted"].mean()),
        "low": low,
        "high": high,
        "would": float(here["would"].mean()),
    }


def _interval(shares: pd.Series) -> tuple[float, float]:
    """Return a t interval, kept within 0 and 1; a share that never varies has no width."""
    if len(shares) and np.ptp(shares) == 0:
        return float(shares.iloc[0]), float(shares.iloc[0])
    found = mean_difference(shares)
    return max(found.low, 0.0), min(found.high, 1.0)
