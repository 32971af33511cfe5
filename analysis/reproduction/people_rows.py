"""The four-lap study's lap times beside the paper's (section V.B)."""

from collections.abc import Iterator

import pandas as pd

from analysis.frames import StudyFrames
from analysis.outcomes import by_participant
from analysis.paper import PAPER
from analysis.reproduction.row import Row
from analysis.reproduction.tolerances import judged
from analysis.stats.describe import describe
from analysis.stats.mean_difference import mean_difference
from analysis.stats.ratio import ratio_of_means

SECTION = "People: lap times (V.B)"

PARTS = {
    "baseline": "baseline",
    "limited": "limited",
    "human-assisted": "demonstrator",
    "model-assisted": "model-1",
}
"""Conditions, and their names in ``analysis.paper``."""

CALIBRATED = ("baseline", "limited")
"""What the population of synthetic participants is fitted to; a cohort of twelve may differ."""


def people_rows(frames: StudyFrames) -> tuple[Row, ...]:
    """Return the rows of ``four-lap``."""
    times = by_participant(frames, "lap_time_s")
    found = [*_means(times), *_gains(times), *_spreads(times)]
    return tuple(map(judged, found))


def _means(times: pd.DataFrame) -> Iterator[Row]:
    for condition in PARTS:
        found, about = describe(times[condition]), mean_difference(times[condition])
        yield Row(
            SECTION, f"lap {condition}", "s", _printed(condition, "mean"), found.mean, found.n,
            about.low, about.high, kind="calibrated" if condition in CALIBRATED else "predicted",
        )  # fmt: skip


def _gains(times: pd.DataFrame) -> Iterator[Row]:
    limited = times["limited"]
    for condition in ("human-assisted", "model-assisted"):
        ratio = ratio_of_means(limited, times[condition])
        yield Row(
            SECTION, f"speedup {condition}", "%", _printed(condition, "speedup"),
            100 * ratio.estimate, ratio.n, 100 * ratio.low, 100 * ratio.high, kind="predicted",
        )  # fmt: skip
        gain = limited - times[condition]
        found, about = describe(gain), mean_difference(gain)
        yield Row(
            SECTION, f"seconds gained {condition}", "s", _printed(condition, "gain"),
            found.mean, found.n, about.low, about.high, kind="predicted",
        )  # fmt: skip


def _spreads(times: pd.DataFrame) -> Iterator[Row]:
    for condition in PARTS:
        found = describe(times[condition])
        yield Row(
            SECTION, f"lap sd {condition}", "s", _printed(condition, "sd"), found.sd, found.n,
            float("nan"), float("nan"),
            kind="calibrated" if condition in CALIBRATED else "predicted",
        )  # fmt: skip


def _printed(condition: str, quantity: str) -> float | None:
    figure = PAPER.get(f"people/{PARTS[condition]}/{quantity}")
    return None if figure is None else figure.value
