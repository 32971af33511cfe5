"""How well the model predicts when and how to help."""

import pandas as pd

from analysis.report.blocks import Block, Paragraph, Picture, Section, Shown, Table, table
from analysis.report.numbers import count, number
from analysis.reproduction.accuracy import Spread, auc, spread
from analysis.reproduction.accuracy_rows import AUC_AFTER_1, AUC_TEST
from analysis.reproduction.evidence import Evidence
from analysis.reproduction.figures.by_demonstration import auc_figure, rmse_figure
from analysis.reproduction.figures.reliability import reliability_figure
from analysis.reproduction.figures.roc import roc_figure
from analysis.reproduction.figures.sample_lap import sample_lap_figure

SAMPLE = 0
"""The run whose test lap is drawn: always the first."""


def accuracy_section(evidence: Evidence) -> Section:
    """Return Figure 4, a to d, and what the paper does not show: calibration."""
    return Section("accuracy", "Model accuracy (Figure 4)", tuple(_blocks(evidence)))


def _blocks(evidence: Evidence) -> list[Block]:
    runs, accuracy = evidence.runs, evidence.accuracy
    laps, n = len(runs[0]), len(runs)
    summary = summary_by_demonstration(accuracy)
    first, last = summary.iloc[1], summary.iloc[-1]
    return [
        Paragraph(
            f"{laps} recorded demonstrations in {n} random orders: a fresh model predicts each "
            "step, and then learns it; the last lap it only predicts. After n demonstrations means "
            f"in the lap that follows them. The {n} runs share the same {laps} laps, so their "
            "spread shows the effect of order, not of new laps."
        ),
        Picture(
            "roc",
            f"(a) When to help: ROC curves with the threshold W_h swept, steps of {n} runs pooled; "
            "the dots are at W_h = 0.5. Rates are shares of steps.",
            f"ROC curves; the median AUC is {number(first['auc'], 3)} after 1 demonstration and "
            f"{number(last['auc'], 3)} in the test lap.",
            roc_figure(runs),
        ),
        Picture(
            "auc",
            f"(b) Area under the ROC curve by demonstration: a point per run (n = {n}), median and "
            "quartiles. The paper's figures: about 0.95 after one, 0.9881 in the test lap.",
            f"Median AUC {number(first['auc'], 3)} after 1, {number(last['auc'], 3)} in the test.",
            auc_figure(accuracy, {1: AUC_AFTER_1, laps - 1: AUC_TEST}),
        ),
        Picture(
            "rmse",
            "(c) How to help: root mean square error of the predicted command in the steps in "
            f"which the demonstrator helped (n = {n} runs; median and quartiles).",
            f"In the test lap {number(last['rmse_v'], 3)} m/s and {number(last['rmse_w'], 3)} "
            "rad/s.",
            rmse_figure(accuracy),
        ),
        Picture(
            "sample_lap",
            f"(d) A test lap (run {SAMPLE + 1} of {n}): p(h = 1 | x); the predicted command with "
            "one standard deviation; the demonstrator's command where there was one (shaded).",
            f"In this lap the AUC is {number(auc(runs[SAMPLE][-1]), 3)}.",
            sample_lap_figure(runs[SAMPLE][-1]),
        ),
        Picture(
            "reliability",
            "Calibration, which the paper does not show: how often the demonstrator helped in "
            f"steps with a given p(h), steps of {n} runs pooled, and how many steps that were.",
            f"Brier score {number(last['brier'], 4)} in the test lap (0 is perfect).",
            reliability_figure(runs),
        ),
        _table(summary),
    ]  # fmt: skip


def summary_by_demonstration(accuracy: pd.DataFrame) -> pd.DataFrame:
    """Return medians over runs, one row per number of demonstrations, with the AUC's quartiles."""
    rows = []
    for before, laps in accuracy.groupby("demonstrations"):
        found: dict[str, Spread] = {
            name: spread(laps[name])
            for name in ("auc", "rmse_v", "rmse_w", "brier", "undecided", "lead_s")
        }
        rows.append(
            {
                "demonstrations": before,
                "runs": len(laps),
                **{name: s.median for name, s in found.items()},
                "auc_low": found["auc"].low,
                "auc_high": found["auc"].high,
            }
        )
    return pd.DataFrame(rows)


def _table(summary: pd.DataFrame) -> Table:
    return table(
        "accuracy_by_demonstration",
        "Medians over runs by the number of demonstrations before the lap. Undecided: share of "
        "steps with |p(h) - 0.5| < 0.001. Lead: by how long p(h) crosses 0.25 before the "
        "demonstrator takes over, mean over the lap's takeovers.",
        summary,
        _COLUMNS,
    )


_COLUMNS = [
    Shown("demonstrations", lambda r: count(r["demonstrations"])),
    Shown("runs", lambda r: count(r["runs"])),
    Shown("AUC", lambda r: number(r["auc"], 4)),
    Shown("quartiles", lambda r: f"{number(r['auc_low'], 4)} to {number(r['auc_high'], 4)}"),
    Shown("RMSE a_v, m/s", lambda r: number(r["rmse_v"], 3)),
    Shown("RMSE a_w, rad/s", lambda r: number(r["rmse_w"], 3)),
    Shown("Brier", lambda r: number(r["brier"], 4)),
    Shown("undecided", lambda r: number(r["undecided"], 4)),
    Shown("lead s", lambda r: number(r["lead_s"], 2)),
]
