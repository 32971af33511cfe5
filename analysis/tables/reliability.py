"""Calibration of the model's p(h): predicted against observed."""

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames
from analysis.lap_records import LapRecords

BINS = 10


def reliability_table(frames: StudyFrames, records: LapRecords) -> pd.DataFrame:
    """Return one row per condition and tenth of p(h = 1 | x) that occurred.

    Columns: condition, ``low`` and ``high`` of the tenth, steps, mean ``predicted`` p, and the
    ``observed`` share of steps in which the shadow demonstrator would help.
    """
    rows = []
    for condition in frames.conditions:
        steps = records.steps[records.steps["condition"] == condition]
        known = steps[["p_help", "h_would"]].dropna()
        tenth = np.clip((known["p_help"] * BINS).astype(int), 0, BINS - 1)
        for i, here in known.groupby(tenth):
            rows.append(
                {
                    "condition": condition,
                    "low": int(str(i)) / BINS,
                    "high": (int(str(i)) + 1) / BINS,
                    "steps": len(here),
                    "predicted": float(here["p_help"].mean()),
                    "observed": float((here["h_would"] > 0).mean()),
                }
            )
    columns = ["condition", "low", "high", "steps", "predicted", "observed"]
    return pd.DataFrame(rows, columns=columns)
