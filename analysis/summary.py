"""The closing table of a run: lap times by condition, and what the paper had."""

import pandas as pd

from analysis.comparisons import lap_time_comparisons
from analysis.frames import study_frames
from analysis.roles import reference_condition
from analysis.tables.lap_times import lap_time_table
from protocols.record.reader import Study


def lap_summary(study: Study) -> pd.DataFrame:
    """Return one row per analysed condition, in the order of the laps.

    Returns
    -------
    DataFrame
        ``condition``; ``n`` finished laps; ``unfinished`` laps; ``mean_s``, ``sd_s``,
        ``median_s``; ``speedup_percent`` over the limited condition (ratio of means over complete
        pairs; NaN for itself or when it cannot be computed); ``paper_mean_s`` (NaN where the
        paper has none).
    """
    frames = study_frames(study)
    table = lap_time_table(frames)
    reference = reference_condition(frames.parts)
    speedups: dict[str, float] = {}
    for c in lap_time_comparisons(frames):
        ratio = c.ratio_of_means
        if ratio is None or not ratio.computed:
            continue
        if c.reference == reference:
            speedups[c.condition] = 100 * ratio.estimate
        elif c.condition == reference:
            speedups[c.reference] = 100 / ratio.estimate
    table["speedup_percent"] = table["condition"].map(speedups).astype("float64")
    columns = ["condition", "n", "unfinished", "mean_s", "sd_s", "median_s", "speedup_percent",
               "paper_mean_s"]  # fmt: skip
    return table[columns]
