"""Mutated study directories: no traceback, no hang, no broken one that passes for a whole one."""

import importlib.util
import random
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pyarrow.parquet as pq
import pytest

from protocols.files.errors import InputError
from protocols.record.check import check_study
from protocols.record.header import STUDY_FILE, StudyHeader, read_header
from protocols.record.parquet import parquet_bytes
from protocols.record.rows import LapRow, ParticipantRow, SurveyRow, participant_id
from protocols.record.session import RecordedLap, SessionRecord, encode
from protocols.record.store import build_tables, open_folder, write_session
from protocols.resolved import ResolvedStudy

SHORT, LONG = 40, 500
SECONDS = 5.0
"""A study directory of a few kilobytes must not take longer, of the processor's time."""

NO_RECORD = ("logs", ".lock", STUDY_FILE)
"""Paths that have no checksum: a study.yaml may be another study's, which its digest tells."""


def loaded(path: str) -> ModuleType:
    """Return a conftest of another folder as a module: it makes small studies."""
    file = Path(__file__).parents[1] / path
    spec = importlib.util.spec_from_file_location(f"made_by_{file.parent.name}", file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def elsewhere() -> ModuleType:
    """Return what makes and reads a study that another program recorded."""
    return loaded("analysis/elsewhere/conftest.py")


@pytest.fixture(scope="module")
def foreign(elsewhere, tmp_path_factory) -> Path:
    """Return a study from elsewhere, its tables with checksums of their pages."""
    folder = elsewhere.clean().write(tmp_path_factory.mktemp("foreign") / "study")
    for path in folder.rglob("*.parquet"):
        path.write_bytes(parquet_bytes(pq.read_table(path)))
    return folder


@pytest.fixture(scope="module")
def own(elsewhere, tmp_path_factory) -> Path:
    """Return a study of our own: two participants, sessions with manifests, tables, codebook."""
    folder = tmp_path_factory.mktemp("own") / "study"
    parts = StudyHeader.model_validate(elsewhere.HEAD)
    cohort = parts.protocol.cohort.model_copy(update={"participants": 2})
    protocol = parts.protocol.model_copy(update={"cohort": cohort})
    plan = ResolvedStudy(protocol, parts.course, parts.instruments)
    open_folder(folder, plan, 0)
    steps = loaded("protocols/record/conftest.py").a_lap_of_steps
    for number in (1, 2):
        write_session(folder, participant_id(number), encode(a_session(plan, number, steps)))
    build_tables(folder)
    assert check_study(folder) == ()
    return folder


def a_session(plan: ResolvedStudy, number: int, steps: Callable) -> SessionRecord:
    """Return a session as planned, of five steps in each lap."""
    rng, who = np.random.default_rng(number), participant_id(number)
    laps, answers = [], []
    for n, lap in enumerate(plan.protocol.laps):
        row = LapRow(
            participant=who, lap=n, condition=lap.condition, practice=lap.practice, limited=False,
            assistant="none", training=False, completed=True, end_reason="finished",
            lap_time_s=0.5 + n / 100, duration_s=0.5 + n / 100, steps=5, collisions=0,
            contact_time_s=0.0, assisted_fraction=0.0, interventions=0, gates_passed=2, seed=n,
        )  # fmt: skip
        laps.append(RecordedLap(row, steps(5, rng)))
        answers += [
            SurveyRow(participant=who, lap=n, condition=lap.condition, instrument=asked.name,
                      item=item.id, response=3)
            for asked, item in plan.questions(lap)
        ]  # fmt: skip
    person = ParticipantRow(
        participant=who, kind="synthetic", driver="human", traits={"speed_m_s": 0.5},
        completed=True, laps_planned=len(laps), laps_driven=len(laps),
    )  # fmt: skip
    return SessionRecord(person, tuple(laps), tuple(answers), model=b"learnt")


def _flipped(content: bytes, rng: random.Random) -> bytes:
    changed = bytearray(content)
    for _ in range(rng.choice((1, 1, 3, 40))):
        changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def _cut(content: bytes, rng: random.Random) -> bytes:
    return content[: rng.randrange(len(content))]


def _without_a_piece(content: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(content))
    return content[:at] + content[at + rng.randrange(1, 60) :]


def _with_a_piece_twice(content: bytes, rng: random.Random) -> bytes:
    at, n = rng.randrange(len(content)), rng.randrange(1, 60)
    return content[: at + n] + content[at:]


def _other_numbers(content: bytes, rng: random.Random) -> bytes:
    digits = [i for i, byte in enumerate(content) if chr(byte).isdigit()] or [0]
    at = rng.choice(digits)
    return content[:at] + rng.choice((b"", b"-", b"9e9", b"x", b"[", b": ")) + content[at + 1 :]


CONTENTS = (_flipped, _flipped, _cut, _without_a_piece, _with_a_piece_twice, _other_numbers)


def mutated(folder: Path, rng: random.Random) -> list[Path]:
    """Change one to three things in a study directory; return the paths that changed."""
    changed: list[Path] = []
    for _ in range(rng.randint(1, 3)):
        files = sorted(p for p in folder.rglob("*") if p.is_file() and p.name != ".lock")
        path = rng.choice(files)
        what = rng.random()
        before = path.read_bytes()
        if what < 0.7:
            path.write_bytes(rng.choice(CONTENTS)(before or b"\0", rng))
        elif what < 0.8:
            path.unlink()
        elif what < 0.85:
            path.unlink()
            path.mkdir()
        elif what < 0.95:
            path.write_bytes(rng.choice(files).read_bytes())
        else:
            path.rename(path.with_name(f"{path.stem}-2{path.suffix}"))
        if not path.is_file() or path.read_bytes() != before:
            changed.append(path.relative_to(folder))
    return changed


def reported(folder: Path, read: Callable) -> str | None:
    """Return why a study directory cannot be analysed; None when it can."""
    refusal = None
    try:
        read(folder)
    except InputError as error:
        refusal = str(error)
    assert refusal is None or "\n" not in refusal
    return refusal


def checked(folder: Path) -> tuple[str, ...]:
    """Return what `check` says of a study directory."""
    try:
        faults = check_study(folder)
    except InputError as error:
        return (str(error),)
    assert all("\n" not in fault for fault in faults)
    return faults


def survives_ours(source: Path, place: Path, seed: int, elsewhere: ModuleType) -> None:
    """Assert that `check` names every change of our own study, and that reading it is safe."""
    folder = shutil.copytree(source, place / "study")
    changed = mutated(folder, random.Random(seed))  # noqa: S311 - which byte, not a secret
    began = time.process_time()
    faults = checked(folder)
    reported(folder, elsewhere.found_in)
    assert time.process_time() - began < SECONDS
    if any(path.parts[0] not in NO_RECORD and not _is_as_it_was(path, source, folder)
           for path in changed):  # fmt: skip
        assert faults, f"changed, and called whole: {changed}"


def _is_as_it_was(path: Path, source: Path, folder: Path) -> bool:
    there = folder / path
    return there.is_file() and there.read_bytes() == (source / path).read_bytes()


def survives_theirs(source: Path, place: Path, seed: int, elsewhere: ModuleType) -> None:
    """Assert that a study from elsewhere is refused, named, or read as it was."""
    clean = elsewhere.found_in(source)
    folder = shutil.copytree(source, place / "study")
    changed = mutated(folder, random.Random(seed))  # noqa: S311 - which byte, not a secret
    began = time.process_time()
    faults = checked(folder)
    refusal = reported(folder, elsewhere.found_in)
    assert time.process_time() - began < SECONDS
    if refusal:
        assert faults, f"refused, and called whole: {refusal}"
    elif Path(STUDY_FILE) not in changed or _same_study(source, folder):
        found = elsewhere.found_in(folder)
        if different := found.differs(clean):
            assert found.words != clean.words, f"{changed}: silently other {different}"


def _same_study(source: Path, folder: Path) -> bool:
    return read_header(source).study == read_header(folder).study


@pytest.mark.parametrize("survives", [survives_ours, survives_theirs])
def test_mutated_directories(own, foreign, elsewhere, tmp_path, survives):
    """The short form: no traceback, no hang, nothing broken that is called whole."""
    source = own if survives is survives_ours else foreign
    for seed in range(SHORT // 2):
        survives(source, tmp_path / str(seed), seed, elsewhere)


@pytest.mark.slow
@pytest.mark.parametrize("survives", [survives_ours, survives_theirs])
def test_mutated_directories_long(own, foreign, elsewhere, tmp_path, survives):
    """The long form: five hundred directories."""
    source = own if survives is survives_ours else foreign
    for seed in range(LONG // 2):
        survives(source, tmp_path / str(seed), 1000 + seed, elsewhere)
