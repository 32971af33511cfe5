"""Studies made up by hand, written through the record's own writer: no simulator, no model."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from analysis.figures.files import Drawing
from analysis.report.blocks import Page
from analysis.report.render import render
from protocols.course.centreline import Centreline
from protocols.load import resolve_study
from protocols.record.reader import Study, open_study
from protocols.record.rows import LapRow, ParticipantRow, SurveyRow, participant_id
from protocols.record.session import RecordedLap, SessionRecord, encode
from protocols.record.steps import STEP_SCHEMA
from protocols.record.store import build_tables, open_folder, write_session
from protocols.resolved import ResolvedStudy

PERIOD = 0.1
CORNER_SPEED = {"none": 0.3, "limited": 0.1, "demonstrator": 0.28, "model": 0.22}


@dataclass(frozen=True)
class MadeUp:
    """How a made-up study differs from an uneventful one.

    Attributes
    ----------
    participants
        How many sessions there are.
    answer
        Response to every question; None: varied ones.
    unfinished
        Laps that ran into the time limit: participant number and lap.
    withdrew
        Lap after whose start a participant left, by participant number.
    words
        Why they left, by participant number.
    excluded
        Reasons for exclusion by participant number.
    unanswered
        Questions without a response: participant number and item.
    living
        Whether living people took part: their steps say how good the link was.
    links
        Fields of a participant's lap rows about the link, by participant number.
    """

    participants: int = 4
    answer: int | None = None
    unfinished: frozenset[tuple[int, int]] = frozenset()
    withdrew: dict[int, int] = field(default_factory=dict)
    words: dict[int, str] = field(default_factory=dict)
    excluded: dict[int, str] = field(default_factory=dict)
    unanswered: frozenset[tuple[int, str]] = frozenset()
    living: bool = False
    links: dict[int, dict[str, Any]] = field(default_factory=dict)


def lap_steps(course: Any, assistant: str, limited: bool, rng: np.random.Generator) -> pd.DataFrame:
    """Return the steps of a lap along the centreline: slow in sharp corners, helped there."""
    line = Centreline(course)
    pace = rng.uniform(0.75, 1.1)
    corner = CORNER_SPEED["limited" if limited and assistant == "none" else assistant]
    arcs = [0.0]
    while arcs[-1] < line.length:
        sharp = line.section(arcs[-1]).kind == "sharp_right"
        arcs.append(arcs[-1] + (corner if sharp else 0.6) * pace * PERIOD)
    arc = np.array(arcs[:-1])
    n = len(arc)
    sections = [line.section(a) for a in arc]
    sharp = np.array([s.kind == "sharp_right" for s in sections])
    heading = np.array([line.point(a).heading for a in arc])
    offset = 0.15 * np.sin(arc * 2 + rng.uniform(0, 6)) * rng.uniform(0.3, 1.5)
    wanted = sharp & limited
    p = np.clip(np.roll(wanted, -3) * 0.8 + 0.1 + rng.normal(0, 0.08, n), 0.001, 0.999)
    helped = {"none": np.zeros(n, bool), "demonstrator": wanted, "model": p >= 0.5}[assistant]
    turning = np.where(sharp, -0.5, rng.normal(0, 0.05, n))
    speed = np.gradient(arc, PERIOD)
    frame = {
        "step": np.arange(n),
        "t_s": np.arange(n) * PERIOD,
        "user_v": speed,
        "user_w": np.where(limited, np.maximum(turning, -0.15), turning),
        "velocity_v": speed,
        "velocity_w": turning,
        **{f"segment_{i:02d}": rng.uniform(0.5, 4.0, n) for i in range(15)},
        "intent_v": speed + rng.normal(0, 0.02, n),
        "intent_w": turning,
        "h_would": np.where(wanted, 1, -1),
        "would_v": np.where(wanted, speed, np.nan),
        "would_w": np.where(wanted, -0.5, np.nan),
        "control": np.where(helped, assistant, "driver"),
        "arbitrated_v": speed,
        "arbitrated_w": turning,
        "executed_v": speed,
        "executed_w": turning,
        "safeguarded": np.zeros(n, bool),
        "result_v": speed,
        "result_w": turning,
        "x_m": np.interp(arc, line.arcs, line.points[:, 0]) - np.sin(heading) * offset,
        "y_m": np.interp(arc, line.arcs, line.points[:, 1]) + np.cos(heading) * offset,
        "heading_rad": heading,
        "arc_m": arc,
        "offset_m": offset,
        "section": [s.name for s in sections],
        "section_kind": [s.kind for s in sections],
        "clearance_m": rng.uniform(0.1, 0.6, n),
        "contact": rng.random(n) < 0.01,
    }
    if assistant == "demonstrator":
        frame |= {"h": frame["h_would"], "a_v": frame["would_v"], "a_w": frame["would_w"]}
    if assistant in ("demonstrator", "model"):
        frame |= {"p_help": p, "mean_v": speed, "mean_w": turning, "variance": np.full(n, 0.02)}
    return pd.DataFrame(frame)


GOOD_LINK = {"late_share": 0.0, "input_age_p99_s": 0.1, "pauses": 0, "paused_s": 0.0}


def link_columns(n: int, number: int, rng: np.random.Generator) -> dict[str, Any]:
    """Return the columns of a living driver's link; later participants' are slower."""
    return {
        "late_s": rng.exponential(0.001 * number, n),
        "shift_s": np.zeros(n),
        "input_age_s": rng.uniform(0, 0.1, n),
        "driver_device": "keyboard",
        "driver_sent_age_s": rng.uniform(0, 0.04, n),
        "driver_round_trip_s": rng.normal(0.02 * number, 0.001, n),
        "driver_frames": np.full(n, 6),
        "driver_attentive": rng.random(n) > 0.02,
    }


def as_table(steps: pd.DataFrame) -> pa.Table:
    """Return steps as a table of the record's schema; NaN is missing."""
    given = [name for name in STEP_SCHEMA.names if name in steps]
    arrays = {
        name: pa.array(steps[name], from_pandas=True).cast(STEP_SCHEMA.field(name).type)
        for name in given
    }
    columns = [arrays.get(f.name, pa.nulls(len(steps), f.type)) for f in STEP_SCHEMA]
    return pa.Table.from_arrays(columns, schema=STEP_SCHEMA)


def session(study: ResolvedStudy, number: int, how: MadeUp, seed: int) -> SessionRecord:
    """Return one participant's made-up session."""
    rng = np.random.default_rng([seed, number])
    who = participant_id(number)
    laps: list[RecordedLap] = []
    answers: list[SurveyRow] = []
    for lap, planned in enumerate(study.protocol.laps):
        condition = study.protocol.conditions[planned.condition]
        limited = condition.limitation is not None
        frame = lap_steps(study.course, condition.assistant, limited, rng)
        if how.living:
            frame = frame.assign(**link_columns(len(frame), number, rng))
        left = how.withdrew.get(number) == lap
        finished = (number, lap) not in how.unfinished and not left
        helped = (frame["control"] != "driver").to_numpy()
        time = float(len(frame) * PERIOD - rng.uniform(0, PERIOD))
        row = LapRow(
            participant=who,
            lap=lap,
            condition=planned.condition,
            practice=planned.practice,
            limited=limited,
            assistant=condition.assistant,
            training=condition.training,
            completed=finished,
            end_reason="finished" if finished else "withdrew" if left else "time_limit",
            withdrawal=how.words.get(number) if left else None,
            lap_time_s=time if finished else None,
            duration_s=time,
            steps=len(frame),
            collisions=int(rng.poisson(0.5)),
            contact_time_s=0.1,
            assisted_fraction=float(helped.mean()),
            interventions=int((np.diff(helped.astype(int), prepend=0) == 1).sum()),
            gates_passed=3 if finished else 1,
            seed=int(rng.integers(2**32)),
            **(how.links.get(number, GOOD_LINK) if how.living else {}),
        )
        laps.append(RecordedLap(row, as_table(frame)))
        if left:
            break
        for instrument, item in study.questions(planned):
            given = how.answer or int(rng.integers(1, instrument.points + 1))
            response = None if (number, item.id) in how.unanswered else given
            answers.append(
                SurveyRow(
                    participant=who,
                    lap=lap,
                    condition=planned.condition,
                    instrument=instrument.name,
                    item=item.id,
                    response=response,
                )
            )
    person = ParticipantRow(
        participant=who,
        kind="live" if how.living else "synthetic",
        driver="human",
        age_years=int(rng.integers(21, 39)),
        gender="female" if rng.random() < 5 / 12 else "male",
        handedness="right",
        traits={"preferred_speed_m_s": 0.6},
        completed=all(lap.row.completed for lap in laps),
        laps_planned=len(study.protocol.laps),
        laps_driven=len(laps),
        excluded=number in how.excluded,
        exclusion_reason=how.excluded.get(number),
    )
    return SessionRecord(person, tuple(laps), tuple(answers), None)


def write_study(
    folder: Path, how: MadeUp, protocol: str | Path = "four-lap", seed: int = 1
) -> Study:
    """Write a made-up study directory, and open it."""
    study = resolve_study(str(protocol), participants=how.participants)
    open_folder(folder, study, seed, "live" if how.living else "simulated")
    for number in range(1, how.participants + 1):
        record = session(study, number, how, seed)
        write_session(folder, record.participant.participant, encode(record))
    build_tables(folder)
    return open_study(folder)


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> Study:
    """Return a made-up four-lap study of six people in which little happens."""
    return write_study(tmp_path_factory.mktemp("made-up") / "study", MadeUp(participants=6))


@pytest.fixture(scope="session")
def write_made_up() -> Callable[..., Study]:
    """Return a function that writes a made-up study of some people into a folder."""

    def write(folder: Path, protocol: str, participants: int) -> Study:
        return write_study(folder, MadeUp(participants=participants), protocol)

    return write


@pytest.fixture
def make_study(tmp_path: Path) -> Callable[..., Study]:
    """Return a function that writes a made-up study with events."""

    def make(protocol: str | Path = "four-lap", **events: Any) -> Study:
        return write_study(tmp_path / "study", replace(MadeUp(), **events), protocol)

    return make


@pytest.fixture
def steps(study: Study) -> dict[str, np.ndarray]:
    """Return the columns of the steps of a lap that the model helped."""
    table = study.steps("P0001", 4)
    return {name: table[name].to_numpy().copy() for name in table.column_names}


@pytest.fixture(scope="session")
def erase() -> Callable[..., None]:
    """Return the function that takes every value of a column out of step tables."""

    def erase(folder: Path, column: str, files: str = "steps-*.parquet") -> None:
        for path in folder.rglob(files):
            steps = pq.read_table(path)
            place = steps.schema.get_field_index(column)
            field = steps.schema.field(place).with_nullable(True)
            nothing = pa.nulls(len(steps), field.type)
            pq.write_table(steps.set_column(place, field, nothing), path)

    return erase


@pytest.fixture(scope="session")
def page_text() -> Callable[[Page], str]:
    """Return a function from a page to its HTML, with every figure left empty."""

    def text(page: Page) -> str:
        empty = {p.name: Drawing(b"", b"", ((0.0, 0.0),) * len(p.spots)) for p in page.pictures}
        return render(page, empty)

    return text
