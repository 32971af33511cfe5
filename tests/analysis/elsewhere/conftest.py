"""A small, clean study that another program might have recorded, and what is computed from it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from analysis.flow import participants_flow
from analysis.frames import study_frames
from analysis.lap_records import read_laps
from analysis.measures.registry import measure
from analysis.outcomes import answers_by_participant, by_participant
from protocols.files.dump import plain_yaml
from protocols.record.reader import open_study

COURSE = {
    "name": "corridor",
    "title": "A corridor",
    "walls": [
        {"name": "around", "points": [[0, 0], [8, 0], [8, 2], [0, 2]], "closed": True},
        {"name": "niche", "points": [[0, 1.9], [3, 1.9]]},
    ],
    "start": {"x": 1.0, "y": 0.8, "heading": 0.0},
    "gates": [
        {"name": "G", "left": [4, 2], "right": [4, 0]},
        {"name": "F", "left": [7, 2], "right": [7, 0]},
    ],
    "centreline": [[1, 0.8], [7, 0.8]],
    "sections": [{"name": "all", "kind": "straight"}],
}
HEAD = {
    "protocol": {
        "name": "elsewhere",
        "title": "Recorded elsewhere",
        "conditions": {
            "manual": {"assistant": "none"},
            "assisted": {"assistant": "demonstrator"},
        },
        # The condition that is practised is analysed, too: numbers alone must not tell which lap.
        "laps": [
            {"condition": "assisted", "practice": True},
            {"condition": "manual", "survey": [{"instrument": "ease", "items": ["q1"]}]},
            {"condition": "assisted", "survey": [{"instrument": "ease", "items": ["q1"]}]},
        ],
        "exclusion": {"max_collisions": 3},
    },
    "instruments": [
        {
            "schema": 1,
            "name": "ease",
            "title": "Ease",
            "anchors": ["a", "b", "c", "d", "e"],
            "agreement_from": 4,
            "items": [{"id": "q1", "text": "It was easy."}],
        }
    ],
    "course": COURSE,
}
HEAD_TEXT = plain_yaml(HEAD)
PEOPLE = ("01", "Ren\u00e9", "04")
COLLIDED = "04"
LAPS = ("assisted", "manual", "assisted")
RATE = 10
LOOKED_AT = tuple(map(measure, ("path_length_m", "driving_time_s", "collisions", "contact_time_s")))
"""Measures that need no column which other programs hardly have: the others cost time here."""


@dataclass
class Recorded:
    """A study's tables in memory, to be changed and then written.

    Attributes
    ----------
    tables
        participants, laps and surveys.
    steps
        By session folder and file name.
    files
        Further files by path, written last: they replace what is there.
    """

    tables: dict[str, pa.Table]
    steps: dict[tuple[str, str], pa.Table]
    files: dict[str, bytes]

    def write(self, folder: Path) -> Path:
        """Write the study directory."""
        folder.mkdir(parents=True)
        (folder / "study.yaml").write_text(HEAD_TEXT, encoding="utf-8")
        for name, table in self.tables.items():
            pq.write_table(table, folder / f"{name}.parquet")
        for (session, name), table in self.steps.items():
            (folder / "sessions" / session).mkdir(parents=True, exist_ok=True)
            pq.write_table(table, folder / "sessions" / session / name)
        for path, content in self.files.items():
            (folder / path).write_bytes(content)
        return folder


def clean() -> Recorded:
    """Return the study with every table as it should be."""
    laps, surveys, steps = [], [], {}
    for n, who in enumerate(PEOPLE):
        for lap, condition in enumerate(LAPS):
            seconds = 6.0 + 0.3 * n - 0.4 * lap
            contacts = 2 if who == COLLIDED else 0
            laps.append((who, lap, condition, lap == 0, True, seconds, seconds, contacts))
            steps[who, f"steps-{lap}.parquet"] = a_lap(seconds, contacts)
            if lap:
                surveys.append((who, lap, condition, "ease", "q1", 1 + (n + 2 * lap) % 5))
    return Recorded(
        {
            "participants": _table(
                ("participant", "consented", "excluded", "exclusion_reason"),
                [(w, True, w == COLLIDED, "too many" if w == COLLIDED else None) for w in PEOPLE],
            ),
            "laps": _table(
                ("participant", "lap", "condition", "practice", "completed", "lap_time_s",
                 "duration_s", "collisions"), laps,
            ),
            "surveys": _table(
                ("participant", "lap", "condition", "instrument", "item", "response"), surveys
            ),
        },
        steps,
        {},
    )  # fmt: skip


def a_lap(seconds: float, contacts: int) -> pa.Table:
    """Return the steps of a lap down the corridor, with some contacts."""
    n = int(seconds * RATE)
    t = np.arange(n) / RATE
    touching = np.zeros(n, dtype=bool)
    touching[[10 * (i + 1) for i in range(contacts)]] = True
    x, y = 1 + 6 * t / seconds, 0.8 + 0.2 * np.sin(t)
    return pa.table({"t_s": t, "x_m": x, "y_m": y, "contact": touching,
                     "control": ["driver"] * n})  # fmt: skip


def _table(names: tuple[str, ...], rows: list[tuple[Any, ...]]) -> pa.Table:
    return pa.table({name: [row[i] for row in rows] for i, name in enumerate(names)})


@dataclass(frozen=True)
class Found:
    """What an analysis says: numbers by name, and everything it says in words."""

    numbers: dict[str, float]
    words: frozenset[str]

    def differs(self, other: "Found") -> list[str]:
        """Return the names of the numbers that are not the same, those not there included."""
        names = sorted(self.numbers.keys() | other.numbers.keys())
        nothing = float("nan")
        return [
            name
            for name in names
            if not np.isclose(
                self.numbers.get(name, nothing),
                other.numbers.get(name, nothing),
                rtol=1e-4,
                atol=1e-5,
                equal_nan=True,
            )
        ]


def found_in(folder: Path) -> Found:
    """Return the statistics of a study directory, and its remarks."""
    study = open_study(folder)
    frames = study_frames(study)
    with mock.patch("analysis.lap_records.MEASURES", LOOKED_AT):
        records = read_laps(frames)
    flow = participants_flow(frames)
    numbers: dict[str, float] = {
        "analysed": flow.analysed,
        "recorded": flow.recorded,
        "refused": flow.refused,
        "excluded": sum(flow.excluded.values()),
        "mapped steps": float(records.steps[["x_m", "y_m"]].notna().all(axis=1).sum()),
    }
    for name, wide in (
        ("time", by_participant(frames, "lap_time_s")),
        ("answer", answers_by_participant(frames, "ease", "q1")),
    ):
        for condition in wide:
            numbers[f"{name}, mean, {condition}"] = float(wide[condition].mean())
            numbers[f"{name}, n, {condition}"] = int(wide[condition].notna().sum())
        numbers[f"{name}, difference"] = float((wide.iloc[:, 0] - wide.iloc[:, 1]).mean())
    for m in LOOKED_AT:
        for condition, values in records.measures.groupby("condition")[m.name]:
            numbers[f"{m.name}, {condition}"] = float(values.mean())
    places = frames.by_place.groupby("condition")["lap"].mean()
    numbers["places apart"] = float(places.max() - places.min()) if len(places) else np.nan
    said = (
        *study.remarks, *flow.left_out, *frames.unread, *records.damaged, *records.misplaced,
        *frames.exclusions.remarks, *(f"{what}: {n}" for what, n in records.gaps.items()),
        f"without steps: {records.without_steps}", f"unrecorded: {records.unrecorded}",
        f"consent unknown: {flow.consent_unknown}",
        f"laps: {flow.laps.to_dict('list')}",
    )  # fmt: skip
    return Found(numbers, frozenset(said))


@pytest.fixture(scope="session")
def recorded() -> Callable[[], Recorded]:
    """Return the function that makes the clean study."""
    return clean


@pytest.fixture(scope="session")
def read_study() -> Callable[[Path], Found]:
    """Return the function from a study directory to its statistics and words."""
    return found_in


@pytest.fixture(scope="session")
def as_clean(tmp_path_factory: pytest.TempPathFactory) -> Found:
    """Return what the clean study says."""
    return found_in(clean().write(tmp_path_factory.mktemp("clean") / "study"))
