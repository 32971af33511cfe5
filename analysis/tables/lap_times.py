"""Lap times by condition."""

import pandas as pd

from analysis.flow import lap_flow
from analysis.frames import StudyFrames
from analysis.outcomes import values
from analysis.paper import paper_figure
from analysis.stats.describe import describe


def lap_time_table(frames: StudyFrames) -> pd.DataFrame:
    """Return one row per condition: laps finished, with a time or without, and not; times in s."""
    flow = {row["condition"]: row for row in lap_flow(frames).to_dict("records")}
    rows = []
    for part in frames.parts:
        found = describe(values(frames, "lap_time_s", part.condition))
        counted = flow[part.condition]
        printed = {
            f"paper_{q}_s": figure.value
            for q in ("mean", "sd")
            if (figure := paper_figure(frames.study.protocol, part, q)) is not None
        }
        unfinished = sum(counted[why] for why in ("time_limit", "withdrew", "unfinished_otherwise"))
        rows.append(
            {
                "condition": part.condition,
                "role": part.role,
                "n": found.n,
                "without_time": counted["finished_without_time"],
                "unfinished": unfinished,
                "not_driven": counted["not_driven"],
                "mean_s": found.mean,
                "sd_s": found.sd,
                "median_s": found.median,
                "min_s": found.low,
                "max_s": found.high,
                "paper_mean_s": float("nan"),
                "paper_sd_s": float("nan"),
                **printed,
            }
        )
    return pd.DataFrame(rows)
