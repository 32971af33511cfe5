"""Every measure by condition."""

import pandas as pd

from analysis.frames import StudyFrames
from analysis.lap_records import LapRecords
from analysis.measures.registry import MEASURES
from analysis.stats.describe import describe


def measure_table(frames: StudyFrames, records: LapRecords) -> pd.DataFrame:
    """Return one row per measure and condition: n, missing, mean, sd, median, extremes.

    Finished laps only: the measures of a lap that was cut short are not those of a lap.
    """
    finished = records.measures[records.measures["completed"]]
    rows = []
    for measure in MEASURES:
        for condition in frames.conditions:
            found = describe(finished.loc[finished["condition"] == condition, measure.name])
            rows.append(
                {
                    "measure": measure.name,
                    "title": measure.title,
                    "unit": measure.unit,
                    "condition": condition,
                    "n": found.n,
                    "missing": found.missing,
                    "mean": found.mean,
                    "sd": found.sd,
                    "median": found.median,
                    "min": found.low,
                    "max": found.high,
                }
            )
    return pd.DataFrame(rows)
