"""The autonomous driver's laps beside the paper's (sections IV.A and IV.E, Figure 3)."""

from collections.abc import Iterator
from typing import Any

import pandas as pd

from analysis.paper import PAPER
from analysis.reproduction.row import Row
from analysis.reproduction.tolerances import judged

SECTION = "Autonomous driver: lap times (IV.A, IV.E)"

PARTS = {
    "baseline": "baseline",
    "limited": "limited",
    "demonstrator": "demonstrator",
    "model after 1": "model-1",
    "model after 2": "model-2",
    "model after 3": "model-3",
    "model after 5": "model-5",
    "model after 10": "model-10",
}
"""Conditions, and their names in ``analysis.paper``."""

CALIBRATED = ("baseline", "limited", "demonstrator")

SPEEDUP_AFTER_3 = 146.0
"""In %: section VI says "137%-146% (after only one to three demonstrations)"."""

BEHIND_AFTER_1 = 2.6
"""In s: the text of section IV.E; its own means give 2.1."""

KS_P = 0.4370
"""Section IV.E."""


def driver_rows(lap_times: pd.DataFrame) -> tuple[Row, ...]:
    """Return the rows of ``rd-laps``.

    Parameters
    ----------
    lap_times
        As ``analysis.reproduction.lap_times`` returns it.
    """
    known: dict[str, dict[str, Any]] = {
        str(row["condition"]): {str(name): value for name, value in row.items()}
        for row in lap_times.to_dict("records")
    }
    found = [*_means(known), *_speedups(known), *_against_demonstrator(known), *_spreads(known)]
    return tuple(map(judged, found))


def _means(known: dict[str, dict[str, Any]]) -> Iterator[Row]:
    for condition in PARTS:
        of = known[condition]
        yield Row(
            SECTION, f"rd lap {condition}", "s", _printed(condition, "mean"), of["mean_s"],
            of["n"], of["low_s"], of["high_s"],
            kind="calibrated" if condition in CALIBRATED else "predicted",
        )  # fmt: skip


def _speedups(known: dict[str, dict[str, Any]]) -> Iterator[Row]:
    for condition in PARTS:
        if condition == "limited":
            continue
        of, printed = known[condition], _printed(condition, "speedup")
        yield Row(
            SECTION, f"speedup {condition}", "%",
            SPEEDUP_AFTER_3 if condition == "model after 3" else printed,
            of["speedup_percent"], of["n"], of["speedup_low"], of["speedup_high"],
            kind="calibrated" if condition in CALIBRATED else "predicted",
        )  # fmt: skip


def _against_demonstrator(known: dict[str, dict[str, Any]]) -> Iterator[Row]:
    once, thrice = known["model after 1"], known["model after 3"]
    yield Row(
        SECTION, "model after 1 minus demonstrator", "s", BEHIND_AFTER_1, once["behind_s"],
        once["n"], once["behind_low"], once["behind_high"], kind="predicted",
    )  # fmt: skip
    yield Row(
        SECTION, "tost model after 3", "s", None, thrice["behind_s"], thrice["n"],
        thrice["tost_low"], thrice["tost_high"], kind="predicted",
    )  # fmt: skip
    nothing = float("nan")
    for quantity, paper, ours in (
        ("ks model after 3", _printed("model after 3", "ks"), thrice["ks"]),
        ("ks p model after 3", KS_P, thrice["ks_p"]),
    ):
        yield Row(
            SECTION, quantity, "", paper, ours, thrice["n"], nothing, nothing, kind="descriptive"
        )


def _spreads(known: dict[str, dict[str, Any]]) -> Iterator[Row]:
    for condition in PARTS:
        of = known[condition]
        yield Row(
            SECTION, f"rd lap sd {condition}", "s", _printed(condition, "sd"), of["sd_s"],
            of["n"], float("nan"), float("nan"), kind="predicted",
        )  # fmt: skip


def _printed(condition: str, quantity: str) -> float | None:
    figure = PAPER.get(f"robot/{PARTS[condition]}/{quantity}")
    return None if figure is None else figure.value
