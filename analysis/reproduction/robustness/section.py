"""Robustness and baselines on the page."""

from collections.abc import Mapping
from typing import Any

import pandas as pd

from analysis.report.blocks import Block, Paragraph, Picture, Section, Shown, Table, table
from analysis.report.numbers import count, number, percent, plural
from analysis.reproduction.robustness.figure import robustness_figure


def robustness_section(variants: pd.DataFrame, costs: Mapping[str, float]) -> Section:
    """Return how other parameters and simpler models change the finding.

    Parameters
    ----------
    variants
        As ``analysis.reproduction.robustness.table.variant_table`` returns it.
    costs
        Cost of a step by variant, us.
    """
    n = int(variants["lap_1_n"].max())
    blocks: list[Block] = [
        Paragraph(
            f"{plural(len(variants) - 1, 'variant')} of the model, each with {n} replicates of its "
            "own that learn in their own demonstrations, and each taught the recorded "
            f"demonstrations in the same {int(variants['auc_1_n'].max())} random orders. "
            "Replicates of all variants drive with the same noise. Nothing was tuned: baselines "
            "have the model's inputs, scikit-learn's default settings and the online regime "
            "(a step is predicted before it is learnt; the refitted ones learn when a "
            "demonstration is over). At W_h = 0.5 equation (10) helps in the same steps as the "
            "default, since both pass 0.5 where the latent mean passes 0: its laps are the same, "
            "its probabilities are not."
        ),
        Picture(
            "robustness",
            "Change against the default model (Table I): mean and 95% interval, paired by random "
            f"order (AUC, all orders of the same laps) or replicate (laps, n = {n}). Black: "
            "better; red: worse; hollow: the interval includes 0. An unfinished lap counts as the "
            "time it was given, so that its change is the least possible. Triangles: out of range.",
            f"Better after one demonstration: {_named(variants, 'd_lap_1', better=True)}. "
            f"Worse: {_named(variants, 'd_lap_1', better=False)}.",
            robustness_figure(variants),
        ),
        _table(variants.assign(cost_us=variants["name"].map(dict(costs)))),
    ]
    return Section("robustness", "Robustness and baselines", tuple(blocks))


def _named(variants: pd.DataFrame, column: str, *, better: bool) -> str:
    sure = variants[f"{column}_high"] < 0 if better else variants[f"{column}_low"] > 0
    return ", ".join(variants.loc[sure, "label"]) or "none"


def _table(variants: pd.DataFrame) -> Table:
    return table(
        "robustness",
        "Medians over random orders: AUC after one demonstration, over the laps learnt from and "
        "in the test lap; of the test lap RMSE, Brier score and undecided steps, those with "
        "|p(h) - 0.5| < 0.001. Laps: mean (sd) after one and three demonstrations, s, how many "
        "replicates finished them (an unfinished lap counts as the time it was given), and "
        "undecided steps in them. Cost: predicting and learning a step of a fourth "
        "demonstration, measured on the machine that made this page; it alone is not the same "
        "in another run.",
        variants,
        _COLUMNS,
    )


def _lap(n: int) -> Shown:
    def cell(r: dict[str, Any]) -> str:
        return f"{number(r[f'lap_{n}_mean'])} ({number(r[f'lap_{n}_sd'])})"

    return Shown(f"lap after {n}", cell)


def _finished(n: int) -> Shown:
    def cell(r: dict[str, Any]) -> str:
        laps, unfinished = int(r[f"lap_{n}_n"]), int(r[f"lap_{n}_unfinished"])
        return f"{laps - unfinished} of {laps}"

    return Shown("finished", cell)


_COLUMNS = [
    Shown("group", lambda r: r["group"], words=True),
    Shown("variant", lambda r: r["label"], words=True),
    Shown("AUC after 1", lambda r: number(r["auc_1"], 3)),
    Shown("training", lambda r: number(r["auc_training"], 4)),
    Shown("test", lambda r: number(r["auc_test"], 4)),
    Shown("RMSE a_v, m/s", lambda r: number(r["rmse_v"], 3)),
    Shown("RMSE a_w, rad/s", lambda r: number(r["rmse_w"], 3)),
    Shown("Brier", lambda r: number(r["brier"], 4)),
    Shown("undecided", lambda r: percent(100 * r["undecided"], 1)),
    _lap(1),
    _finished(1),
    Shown("undecided", lambda r: percent(100 * r["lap_1_undecided"], 1)),
    _lap(3),
    _finished(3),
    Shown("undecided", lambda r: percent(100 * r["lap_3_undecided"], 1)),
    Shown("µs a step", lambda r: count(r["cost_us"])),
]
