"""Small sessions and study directories, made through the project's own writer."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from protocols.files.dump import plain_yaml
from protocols.load import resolve_study
from protocols.record.recorder import StepRecorder
from protocols.record.rows import LapRow, ParticipantRow, SurveyRow, participant_id
from protocols.record.session import RecordedLap, SessionRecord, encode
from protocols.record.store import build_tables, open_folder, write_session
from protocols.resolved import ResolvedStudy


def a_lap_of_steps(n: int, rng: np.random.Generator) -> pa.Table:
    """Return n steps of a lap with a shadow demonstrator and no model."""
    recorder = StepRecorder()
    for step in range(n):
        v, w = rng.random(2)
        recorder.append(
            rng.random(19), step=step, t_s=0.1 * step, intent_v=v, intent_w=w, h_would=-1,
            control="driver", arbitrated_v=v, arbitrated_w=w, executed_v=v, executed_w=w,
            safeguarded=False, result_v=v, result_w=w, x_m=v, y_m=w, heading_rad=w, arc_m=v,
            offset_m=w, section="hall", section_kind="straight", clearance_m=v, contact=False,
        )  # fmt: skip
    return recorder.table()


def a_session(number: int, laps: int = 2) -> SessionRecord:
    """Return a small session; the same number gives the same session."""
    rng = np.random.default_rng(number)
    name = participant_id(number)
    recorded = []
    for lap in range(laps):
        row = LapRow(
            participant=name, lap=lap, condition="limited", practice=False, limited=True,
            assistant="none", training=False, completed=True, end_reason="finished",
            lap_time_s=40 + rng.random(), duration_s=41.0, steps=5, collisions=0,
            contact_time_s=0.0, assisted_fraction=0.0, interventions=0, gates_passed=3,
            seed=2**64 - 1 - lap,
        )  # fmt: skip
        recorded.append(RecordedLap(row, a_lap_of_steps(5, rng)))
    answers = tuple(
        SurveyRow(participant=name, lap=1, condition="limited", instrument="driving-assistance",
                  item=item, response=response)
        for item, response in (("Q1", 4), ("Q2", None), ("Q3", 5), ("Q4", 1))
    )  # fmt: skip
    person = ParticipantRow(
        participant=name, kind="synthetic", driver="human", traits={"speed_m_s": 0.5, "age": 1.0},
        completed=True, laps_planned=laps, laps_driven=laps,
    )  # fmt: skip
    return SessionRecord(person, tuple(recorded), answers, model=b"learnt")


@pytest.fixture(scope="session")
def plan() -> ResolvedStudy:
    """Return the shipped study, for three participants."""
    return resolve_study("four-lap", participants=3)


@pytest.fixture(scope="session")
def make_session() -> Callable[..., SessionRecord]:
    """Return the function that makes a small session."""
    return a_session


@pytest.fixture(scope="session")
def make_steps() -> Callable[[int, np.random.Generator], pa.Table]:
    """Return the function that makes a lap's steps."""
    return a_lap_of_steps


@pytest.fixture(scope="session")
def session_files() -> dict[str, dict[str, bytes]]:
    """Return the files of three sessions by participant."""
    return {participant_id(n): encode(a_session(n)) for n in (1, 2, 3)}


@pytest.fixture
def folder(tmp_path: Path, plan: ResolvedStudy, session_files: dict[str, dict[str, bytes]]) -> Path:
    """Return a finished study directory."""
    out = tmp_path / "study"
    open_folder(out, plan, 0)
    for name, files in session_files.items():
        write_session(out, name, files)
    build_tables(out)
    return out


@pytest.fixture
def ward(tmp_path: Path, plan: ResolvedStudy) -> Path:
    """Return a study that was recorded elsewhere: a short head, and the tables it must have."""
    out = tmp_path / "ward"
    (out / "sessions" / "Ann").mkdir(parents=True)
    head = {
        "protocol": {
            "name": "ward", "title": "On a ward", "conditions": {"with": {}, "without": {}},
            "laps": [{"condition": "without"}, {"condition": "with"}],
        },
        "course": plan.course.model_dump(mode="json", by_alias=True),
    }  # fmt: skip
    (out / "study.yaml").write_text(plain_yaml(head))
    pd.DataFrame({"participant": ["Ann", "Bea"]}).to_parquet(out / "participants.parquet")
    laps = pd.DataFrame(
        {"participant": ["Ann", "Ann", "Bea"], "lap": [0, 1, 0], "completed": True,
         "condition": ["without", "with", "without"], "lap_time_s": [50.0, 45.0, 60.0]}
    )  # fmt: skip
    laps.to_parquet(out / "laps.parquet")
    steps = pd.DataFrame({"t_s": [0.0, 0.1], "x_m": [1.0, 1.1], "y_m": [2.0, 2.0]})
    steps.to_parquet(out / "sessions" / "Ann" / "steps-1.parquet")
    return out
