"""Model quality: did it know when to help."""

from collections.abc import Callable
from typing import Any

import pandas as pd

from analysis.figures.model_quality import auc_points, model_figure
from analysis.report.blocks import Block, Picture, Section, Shown, table
from analysis.report.lap_links import lap_spots
from analysis.report.numbers import count, number
from analysis.results import StudyResults


def model_section(results: StudyResults) -> Section:
    """Return AUC, Brier score and calibration against the shadow demonstrator."""
    taught = tuple(part for part in results.frames.parts if part.taught)
    conditions = [part.condition for part in taught]
    measures = results.records.measures
    measures = measures[measures["condition"].isin(conditions) & measures["completed"]]
    reliability = results.reliability
    reliability = reliability[reliability["condition"].isin(conditions)]
    auc = measures.groupby("condition", sort=False)["when_auc"].agg(["count", "median"])
    aucs = "; ".join(
        f"{condition} median AUC {number(row['median'], 3)} over {int(row['count'])} finished laps"
        for condition, row in auc.iterrows()
        if row["count"]
    )
    points = auc_points(measures, taught)
    points = points.assign(
        y=points["when_auc"], value=[f"AUC {number(auc, 3)}" for auc in points["when_auc"]]
    )
    return Section(
        "model",
        "Model quality",
        (
            Picture(
                "model_quality",
                "Left: area under the ROC curve of p(h = 1 | x) against what the demonstrator did "
                "or, as a shadow, would have done, of every finished lap (bar and number: median; "
                "dotted: chance). Right: reliability, steps of all laps, unfinished ones too, "
                "pooled in tenths of p. Predictions were recorded before the model learnt from a "
                "step: they are out of sample. Laps before the first demonstration are left out: "
                "there the model has learnt nothing.",
                f"Model quality: {aucs or 'nothing to compare'}.",
                model_figure(measures, reliability, taught),
                lap_spots(results, points),
            ),
            table("reliability", "Reliability of p(h = 1 | x), pooled over the steps of all laps.",
                  reliability, _COLUMNS, folded=True),
            *tuning_blocks(results.frames.laps),
        ),
    )  # fmt: skip


def tuning_blocks(laps: pd.DataFrame) -> tuple[Block, ...]:
    """Return a table of hyperparameters that the evidence chose; none where it chose none."""
    names = [name for name in laps.columns if name.startswith("tuned_")]
    if not names or laps["tuned_steps"].isna().all():
        return ()
    rows = laps.dropna(subset=["tuned_steps"]).groupby("condition", sort=False)[names].median()
    columns = [
        Shown("condition", lambda r: r["condition"], words=True),
        *(Shown(name.removeprefix("tuned_").replace("_", " "), _median_of(name)) for name in names),
    ]
    caption = (
        "Hyperparameters that the evidence of what was taught has chosen at the start of the laps: "
        "medians by condition, in the units of the record. What is not here stood as the protocol "
        "has it."
    )
    return (table("tuning", caption, rows.reset_index(), columns, folded=True),)


def _median_of(name: str) -> Callable[[Any], str]:
    return lambda row: f"{row[name]:.3g}"


_COLUMNS = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("p from", lambda r: number(r["low"])),
    Shown("to", lambda r: number(r["high"])),
    Shown("steps", lambda r: count(r["steps"])),
    Shown("mean p", lambda r: number(r["predicted"], 3)),
    Shown("would help", lambda r: number(r["observed"], 3)),
]
