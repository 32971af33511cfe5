"""Model quality: did it know when to help."""

from analysis.figures.model_quality import model_figure
from analysis.report.blocks import Picture, Section, Shown, table
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
    return Section(
        "model",
        "Model quality",
        (
            Picture(
                "model_quality",
                "Left: area under the ROC curve of p(h = 1 | x) against what the demonstrator did "
                "or, as a shadow, would have done, of every finished lap (bar: median; dotted: "
                "chance). Right: reliability, steps of all laps, unfinished ones too, pooled in "
                "tenths of p. Predictions were recorded before "
                "the model learnt from a step: they are out of sample. Laps before the first "
                "demonstration are left out: there the model has learnt nothing.",
                f"Model quality: {aucs or 'nothing to compare'}.",
                model_figure(measures, reliability, taught),
            ),
            table("reliability", "Reliability of p(h = 1 | x), pooled over the steps of all laps.",
                  reliability, _COLUMNS, folded=True),
        ),
    )  # fmt: skip


_COLUMNS = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("p from", lambda r: number(r["low"])),
    Shown("to", lambda r: number(r["high"])),
    Shown("steps", lambda r: count(r["steps"])),
    Shown("mean p", lambda r: number(r["predicted"], 3)),
    Shown("would help", lambda r: number(r["observed"], 3)),
]
