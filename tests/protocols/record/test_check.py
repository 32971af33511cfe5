"""Verifying a study directory."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from protocols.course.centreline import Centreline
from protocols.load import resolve_study
from protocols.record.check import check_study
from protocols.record.manifest import MANIFEST_FILE, manifest_of
from protocols.record.session import SessionRecord, encode
from protocols.record.store import build_tables, open_folder, write_failure, write_session
from protocols.resolved import ResolvedStudy


def test_a_finished_study_has_no_faults(folder: Path):
    """What our own writer made passes."""
    assert check_study(folder) == ()


@pytest.mark.parametrize(
    "name", ["steps-0.parquet", "lap_rows.parquet", "model.npz", "manifest.json"]
)
def test_a_damaged_session_file_is_named(folder: Path, name: str):
    """A changed byte in any file of a session is found, and what to do is said."""
    path = folder / "sessions" / "P0002" / name
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    faults = check_study(folder)
    assert any(str(path.parent) in f and "remove" in f for f in faults)


def test_missing_sessions_are_counted(folder: Path):
    """A study that is not finished says how many sessions it lacks."""
    open_folder(folder, resolve_study("four-lap", participants=10), 0)
    (fault,) = check_study(folder)
    assert fault.startswith("7 of 10 sessions are missing (P0004 first)")


def test_failed_sessions_are_told_from_missing_ones(folder: Path):
    """They have another remedy."""
    open_folder(folder, resolve_study("four-lap", participants=6), 0)
    write_failure(folder, "P0005", "Traceback")
    missing, failed = check_study(folder)
    assert missing.startswith("2 of 6 sessions are missing (P0004 first)")
    assert failed.startswith("1 of 6 sessions failed (P0005 first")
    assert "--retry-failed" in failed


def test_a_session_of_another_study_is_told(
    folder: Path, make_session: Callable[..., SessionRecord]
):
    """However whole it is, the tables would mix two studies."""
    open_folder(folder, resolve_study("four-lap", participants=4), 0)
    write_session(folder, "P0004", encode(make_session(4), "e" * 64))
    build_tables(folder)
    (fault,) = check_study(folder)
    assert "P0004: a session of another study" in fault
    assert "remove" in fault


def test_sessions_beyond_the_plan_are_told(folder: Path):
    """study.yaml was changed to fewer participants than were recorded."""
    head = folder / "study.yaml"
    head.write_text(head.read_text().replace("participants: 3", "participants: 2"))
    (fault,) = check_study(folder)
    assert "1 sessions beyond the 2 participants planned (P0003 first)" in fault


def test_a_steps_file_of_no_lap_is_told(tmp_path: Path, make_session: Callable[..., SessionRecord]):
    """A session holds a file for each of its laps, and no other, whatever its manifest says."""
    files = {n: c for n, c in encode(make_session(1)).items() if n != MANIFEST_FILE}
    files["steps-7.parquet"] = files.pop("steps-1.parquet")
    open_folder(tmp_path / "s", resolve_study("four-lap", participants=1), 0)
    write_session(tmp_path / "s", "P0001", files | {MANIFEST_FILE: manifest_of(files)})
    build_tables(tmp_path / "s")
    missing, stray = check_study(tmp_path / "s")
    assert "steps-1.parquet: missing" in missing
    assert "steps-7.parquet: of a lap without a row" in stray


def test_a_study_recorded_elsewhere_is_read_whole(ward: Path, plan: ResolvedStudy):
    """It has no checksums: its tables are held against one another and against the course."""
    clock, place = check_study(ward)
    assert "t_s does not last as long as the lap" in clock
    assert "positions of 1 lap do not fit the course" in place
    line, path = Centreline(plan.course), ward / "sessions" / "Ann" / "steps-1.parquet"
    t = np.arange(0, 45, 0.1)
    way = [line.point(arc) for arc in t / 45 * line.length]
    steps = {"t_s": t, "x_m": [p.x for p in way], "y_m": [p.y for p in way]}
    pq.write_table(pa.table(steps), path)
    assert check_study(ward) == ()
    path.write_bytes(b"PAR1")
    (fault,) = check_study(ward)
    assert "steps-1.parquet: not a readable Parquet file" in fault


def test_what_is_being_looked_at_is_told(folder: Path):
    """Thousands of sessions take a while."""
    told: list[str] = []
    check_study(folder, told.append)
    assert told == [f"Session {n} of 3" for n in (1, 2, 3)]


def test_tables_that_do_not_hold_the_sessions_are_named(
    folder: Path, make_session: Callable[..., SessionRecord]
):
    """A session added after the tables were built makes all three of them stale."""
    open_folder(folder, resolve_study("four-lap", participants=4), 0)
    write_session(folder, "P0004", encode(make_session(4)))
    names = [fault.partition(":")[0] for fault in check_study(folder)]
    assert names == [str(folder / f"{t}.parquet") for t in ("surveys", "laps", "participants")]
    build_tables(folder)
    assert check_study(folder) == ()


def test_an_unreadable_table_is_named(folder: Path):
    """A truncated table is told as such."""
    (folder / "laps.parquet").write_bytes(b"PAR1")
    (fault,) = check_study(folder)
    assert fault.startswith(f"{folder / 'laps.parquet'}: not a readable Parquet file")


def test_rows_that_contradict_one_another_are_told(
    tmp_path: Path, make_session: Callable[..., SessionRecord]
):
    """Counts in rows that differ from the files, and rows of another participant, are faults."""
    session = make_session(1)
    wrong_steps = replace(session.laps[0], row=replace(session.laps[0].row, steps=6))
    cases = {
        "steps-0.parquet: 5 steps; the lap's row has 6": replace(
            session, laps=(wrong_steps, session.laps[1])),
        "lap_rows.parquet: 2 laps; the participant's row has [3]": replace(
            session, participant=replace(session.participant, laps_driven=3)),
        "rows of P0002 in the session of P0001": replace(
            session, participant=replace(session.participant, participant="P0002")),
        "survey_rows.parquet: 3 answers; the protocol asks 4 questions": replace(
            session, answers=session.answers[1:]),
    }  # fmt: skip
    for n, (message, bad) in enumerate(cases.items()):
        out = tmp_path / str(n)
        open_folder(out, resolve_study("four-lap", participants=1), 0)
        write_session(out, "P0001", encode(bad))
        build_tables(out)
        faults = check_study(out)
        assert len(faults) == 1
        assert message in faults[0]


def test_a_changed_head_or_codebook_is_told(folder: Path):
    """A study.yaml edited after the run, and a lost codebook, are faults."""
    path = folder / "study.yaml"
    path.write_text(path.read_text().replace("right_turn_rad_s: 0.15", "right_turn_rad_s: 0.25"))
    (folder / "codebook.json").unlink()
    head, book = check_study(folder)
    assert "was changed after the run" in head
    assert "codebook.json: missing" in book
