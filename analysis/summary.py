"""The closing table of a run: lap times by condition, and what the paper had."""

import pandas as pd

from analysis.results import StudyResults
from analysis.roles import reference_condition
from analysis.tables.lap_times import lap_time_table


def lap_summary(results: StudyResults) -> pd.DataFrame:
    """Return one row per analysed condition, in the order of the laps.

    Parameters
    ----------
    results
        What the report was written from: nothing is computed a second time.

    Returns
    -------
    DataFrame
        ``condition``; ``n`` finished laps; ``unfinished`` laps; ``mean_s``, ``sd_s``,
        ``median_s``; ``speedup_percent`` over the limited condition (ratio of means over complete
        pairs; NaN for itself or when it cannot be computed); ``paper_mean_s`` (NaN where the
        paper has none).
    """
    table = lap_time_table(results.frames)
    reference = reference_condition(results.frames.parts)
    speedups: dict[str, float] = {}
    for c in results.lap_times:
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
