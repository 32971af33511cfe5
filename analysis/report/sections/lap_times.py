"""Lap times by condition, and speedups."""

from typing import Any

import pandas as pd

from analysis.figures.lap_times import lap_time_figure
from analysis.lap_pages.study_page import analysed_laps
from analysis.report.blocks import Picture, Section, Shown, table
from analysis.report.lap_links import lap_spots
from analysis.report.numbers import count, interval, number, percent
from analysis.results import StudyResults
from analysis.tables.comparisons import speedup_table
from analysis.tables.lap_times import lap_time_table


def lap_time_section(results: StudyResults) -> Section:
    """Return lap times by condition, every participant a line, and their numbers."""
    frames = results.frames
    times = lap_time_table(frames)
    replicates = frames.study.protocol.replicates is not None
    figure_6, their_speedup = _THEIRS if replicates else ("", "")
    known = times.dropna(subset=["paper_mean_s"])
    paper = dict(zip(known["condition"], known["paper_mean_s"], strict=True))
    said = "; ".join(
        f"{r['condition']} mean {number(r['mean_s'])} s (sd {number(r['sd_s'])}, n = {r['n']}, "
        f"{r['unfinished']} unfinished)"
        for r in times.to_dict("records")
    )
    return Section(
        "lap-times",
        "Lap times",
        (
            Picture(
                "lap_times",
                "Lap times by condition: every participant a line, mean and standard deviation "
                "beside it, unfinished laps as crosses where they ended"
                f"{figure_6}.",
                f"Lap times by condition: {said}.",
                lap_time_figure(frames.laps, frames.parts, paper),
                lap_spots(results, _points(results)),
            ),
            table("lap_times", "Lap times of finished laps, in seconds. Unfinished laps and laps "
                  "that were not driven are counted, not averaged.",
                  times if replicates else times.drop(columns=["paper_mean_s", "paper_sd_s"]),
                  [*_TIMES, *(_PAPER if replicates else ())]),
            table("speedups", "Speedups over complete pairs. Percentages are reference / condition"
                  f"{their_speedup}: above 100% the condition is faster. Intervals: 95%, of gain "
                  "and mean of ratios from t, of the ratio of means after Fieller.",
                  speedup_table(results.lap_times), _SPEEDUPS),
        ),
    )  # fmt: skip


def _points(results: StudyResults) -> pd.DataFrame:
    """Return where every lap's point is in the figure; see ``lap_spots``."""
    at = {part.condition: i for i, part in enumerate(results.frames.parts)}
    rows = [
        (one.participant, one.lap, at[one.condition], one.time_s, f"{number(one.time_s)} s")
        for one in analysed_laps(results)
    ]
    return pd.DataFrame(rows, columns=["participant", "lap", "x", "y", "value"])


_THEIRS = (" (the paper's Figure 6)", " (the paper's 137%)")
_TIMES = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("n", lambda r: count(r["n"])),
    Shown("finished, no time", lambda r: count(r["without_time"])),
    Shown("unfinished", lambda r: count(r["unfinished"])),
    Shown("not driven", lambda r: count(r["not_driven"])),
    Shown("mean", lambda r: number(r["mean_s"])),
    Shown("sd", lambda r: number(r["sd_s"])),
    Shown("median", lambda r: number(r["median_s"])),
    Shown("range", lambda r: interval(r["min_s"], r["max_s"])),
]
_PAPER = [
    Shown("paper: mean", lambda r: number(r["paper_mean_s"], 2)),
    Shown("paper: sd", lambda r: number(r["paper_sd_s"], 2)),
]


def _ratio(name: str) -> list[Shown]:
    def cell(row: dict[str, Any]) -> str:
        return percent(row[f"{name}_percent"])

    def ends(row: dict[str, Any]) -> str:
        return interval(row[f"{name}_percent_low"], row[f"{name}_percent_high"], 0)

    return [Shown(name.replace("_", " "), cell), Shown("95%", ends)]


_SPEEDUPS = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("reference", lambda r: r["reference"], words=True),
    Shown("n", lambda r: count(r["n"])),
    Shown("gained / s", lambda r: number(r["gain_s"])),
    Shown("95%", lambda r: interval(r["gain_s_low"], r["gain_s_high"])),
    *_ratio("ratio_of_means"),
    *_ratio("mean_of_ratios"),
]
