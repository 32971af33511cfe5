"""The study's numbers beside the paper's."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import pandas as pd

from analysis.comparisons import PairedComparison
from analysis.frames import StudyFrames
from analysis.outcomes import by_participant, values
from analysis.paper import PaperFigure, paper_figure
from analysis.roles import Part, first
from analysis.stats.describe import describe
from analysis.stats.ratio import mean_of_ratios
from analysis.stats.result import TestResult


@dataclass(frozen=True, slots=True)
class _Ours:
    """A number of the study, with the paper's."""

    part: Part
    quantity: str
    what: str
    value: float
    low: float = math.nan
    high: float = math.nan


def paper_table(
    frames: StudyFrames,
    comparisons: Sequence[PairedComparison],
    surveys: Iterable[pd.DataFrame],
    measures: pd.DataFrame,
) -> pd.DataFrame:
    """Return one row per number that the paper prints and this study has too.

    Parameters
    ----------
    frames
        The study.
    comparisons
        Lap times of every two conditions.
    surveys
        Survey tables, one per instrument.
    measures
        Every measure by condition.
    """
    ours = [
        *_lap_times(frames),
        *_speedups(frames, comparisons),
        *_agreement(frames, surveys),
        *_discrimination(frames, measures),
    ]
    found = ((o, paper_figure(frames.study.protocol, o.part, o.quantity)) for o in ours)
    columns = ["what", "unit", "paper", "ours", "ours_low", "ours_high", "section", "remark"]
    return pd.DataFrame([_row(o, p) for o, p in found if p is not None], columns=columns)


def _row(ours: _Ours, paper: PaperFigure) -> dict[str, object]:
    return {
        "what": ours.what,
        "unit": paper.unit,
        "paper": paper.value,
        "ours": ours.value,
        "ours_low": ours.low,
        "ours_high": ours.high,
        "section": paper.section,
        "remark": paper.remark,
    }


def _lap_times(frames: StudyFrames) -> Iterator[_Ours]:
    for part in frames.parts:
        found = describe(values(frames, "lap_time_s", part.condition))
        yield _Ours(part, "mean", f"{part.condition}: mean lap time", found.mean)
        yield _Ours(part, "sd", f"{part.condition}: sd of lap times", found.sd)


def _speedups(frames: StudyFrames, comparisons: Iterable[PairedComparison]) -> Iterator[_Ours]:
    parts = {part.condition: part for part in frames.parts}
    limited, baseline = first(frames.parts, "limited"), first(frames.parts, "baseline")
    for c in comparisons:
        part = parts[c.condition]
        if c.ratio_of_means is None or c.mean_of_ratios is None or c.difference is None:
            continue
        if c.reference == limited:
            for ratio in (c.ratio_of_means, c.mean_of_ratios):
                what = f"{c.condition}: speedup over {limited}, {ratio.name}"
                ends = [100 * r for r in (ratio.estimate, ratio.low, ratio.high)]
                yield _Ours(part, "speedup", what, *ends)
            what = f"{c.condition}: seconds gained over {limited}"
            gain = c.difference
            yield _Ours(part, "gain", what, -gain.estimate, -gain.high, -gain.low)
        if c.ks is not None and (part.role, parts[c.reference].role) == ("model", "demonstrator"):
            what = f"{c.condition}: Kolmogorov-Smirnov distance from {c.reference}"
            yield _Ours(part, "ks", what, c.ks.statistic)
        if c.reference == baseline and c.condition == limited:
            yield from _increase(frames, part, baseline, c.ratio_of_means)


def _increase(frames: StudyFrames, part: Part, baseline: str, ratio: TestResult) -> Iterator[_Ours]:
    """Yield the increase through the limitation, both ways; either may be the paper's 62%."""
    what = f"{part.condition}: increase over {baseline}"
    more = [100 * (1 / r - 1) for r in (ratio.estimate, ratio.high, ratio.low)]
    yield _Ours(part, "increase", f"{what}, ratio of means", *more)
    wide = by_participant(frames, "lap_time_s")
    found = mean_of_ratios(wide[part.condition], wide[baseline])
    more = [100 * (r - 1) for r in (found.estimate, found.low, found.high)]
    yield _Ours(part, "increase", f"{what}, mean of ratios", *more)


def _agreement(frames: StudyFrames, surveys: Iterable[pd.DataFrame]) -> Iterator[_Ours]:
    parts = {part.condition: part for part in frames.parts}
    for table in surveys:
        for row in table.to_dict("records"):
            what = f"{row['condition']}: agreement with {row['item']}"
            yield _Ours(parts[row["condition"]], row["item"], what, row["agree_percent"])


def _discrimination(frames: StudyFrames, measures: pd.DataFrame) -> Iterator[_Ours]:
    auc = measures[measures["measure"] == "when_auc"].set_index("condition")["median"]
    for part in frames.parts:
        what = f"{part.condition}: when-AUC, median over laps"
        yield _Ours(part, "auc", what, float(auc[part.condition]))
