"""Session folders: each there whole or not at all."""

import contextlib
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from protocols.record import sessions
from protocols.record.session import SessionRecord, encode
from protocols.record.sessions import (
    finished_sessions,
    is_whole,
    read_manifest,
    session_faults,
    write_session,
)


def _content(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_a_session_is_written_as_given(tmp_path: Path, session_files: dict):
    """Every file arrives with its bytes, and nothing else is left behind."""
    write_session(tmp_path, "P0001", session_files["P0001"])
    assert _content(tmp_path / "sessions" / "P0001") == session_files["P0001"]
    assert [p.name for p in (tmp_path / "sessions").iterdir()] == ["P0001"]
    assert finished_sessions(tmp_path) == ("P0001",)
    assert list(session_faults(tmp_path / "sessions" / "P0001")) == []


def test_files_that_do_not_match_their_manifest_are_refused(tmp_path: Path, session_files: dict):
    """Bytes that changed on their way from a worker never get into the record."""
    for files in (
        session_files["P0001"] | {"lap_rows.parquet": b"x"},
        session_files["P0001"] | {"extra": b"x"},
        {k: v for k, v in session_files["P0001"].items() if k != "steps-0.parquet"},
        {k: v for k, v in session_files["P0001"].items() if k != "manifest.json"},
    ):
        with pytest.raises(ValueError, match="do not match their manifest"):
            write_session(tmp_path, "P0001", files)
    assert finished_sessions(tmp_path) == ()


def test_a_whole_session_is_never_overwritten(tmp_path: Path, session_files: dict):
    """What was finished stays, byte for byte."""
    write_session(tmp_path, "P0001", session_files["P0001"])
    write_session(tmp_path, "P0001", session_files["P0002"])
    assert _content(tmp_path / "sessions" / "P0001") == session_files["P0001"]


def test_a_session_of_another_study_is_replaced(
    tmp_path: Path, make_session: Callable[..., SessionRecord]
):
    """It does not count as finished here; one that does not say what it is of does."""
    ours, theirs = "a" * 64, "b" * 64
    write_session(tmp_path, "P0001", encode(make_session(1), theirs))
    write_session(tmp_path, "P0002", encode(make_session(2)))
    assert finished_sessions(tmp_path) == ("P0001", "P0002")
    assert finished_sessions(tmp_path, ours) == ("P0002",)
    files = encode(make_session(1), ours)
    write_session(tmp_path, "P0001", files)
    assert _content(tmp_path / "sessions" / "P0001") == files


@pytest.mark.parametrize("at", range(12))
def test_a_write_error_at_any_moment_leaves_no_session(
    tmp_path: Path, session_files: dict, monkeypatch: pytest.MonkeyPatch, at: int
):
    """A full disk at the nth write or sync: no session, no rubbish; the next try succeeds."""
    calls = iter(range(100))

    def failing(original):
        def call(*args: object) -> object:
            if next(calls) == at:
                raise OSError(28, "No space left on device")
            return original(*args)

        return call

    write_session(tmp_path, "P0002", session_files["P0002"])
    with monkeypatch.context() as patch:
        for name in ("write_through", "sync_folder", "_delete"):
            patch.setattr(sessions, name, failing(getattr(sessions, name)))
        with contextlib.suppress(OSError):
            write_session(tmp_path, "P0001", session_files["P0001"])
    # Seven files, the folder, a look at what is in the way; then it has its name.
    there = {"P0001", "P0002"} if at >= 9 else {"P0002"}
    assert {p.name for p in (tmp_path / "sessions").iterdir()} == there
    write_session(tmp_path, "P0001", session_files["P0001"])
    assert finished_sessions(tmp_path) == ("P0001", "P0002")
    assert _content(tmp_path / "sessions" / "P0001") == session_files["P0001"]


_KILLED = """
import os, pickle, sys
from pathlib import Path
from protocols.record import sessions
countdown = int(sys.argv[2])
def dying(original):
    def call(*args):
        global countdown
        countdown -= 1
        if countdown == 0:
            if original.__name__ == "write_through":
                args[0].write_bytes(args[1][: len(args[1]) // 2])
            os._exit(9)
        return original(*args)
    return call
for name in ("write_through", "sync_folder", "_delete"):
    setattr(sessions, name, dying(getattr(sessions, name)))
sessions.write_session(Path(sys.argv[1]), "P0001", pickle.load(sys.stdin.buffer))
"""


@pytest.mark.parametrize("at", [1, 4, 8, 9, 10])
def test_a_killed_writer_leaves_a_whole_session_or_none(
    tmp_path: Path, session_files: dict, at: int
):
    """Whenever the process dies, also in the middle of a file, nothing half-written counts."""
    killed = subprocess.run(  # noqa: S603  # our own interpreter and code
        [sys.executable, "-c", _KILLED, str(tmp_path), str(at)],
        input=pickle.dumps(session_files["P0001"]),
        check=False,
    )
    assert killed.returncode == 9
    assert finished_sessions(tmp_path) == (("P0001",) if at == 10 else ())
    write_session(tmp_path, "P0001", session_files["P0001"])
    assert _content(tmp_path / "sessions" / "P0001") == session_files["P0001"]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40)
@given(data=st.data())
def test_a_truncated_or_missing_file_makes_a_session_unfinished(
    tmp_path: Path, session_files: dict, data: st.DataObject
):
    """Whichever file is cut or lost, the session no longer counts, and is replaced when redone."""
    files = session_files["P0001"]
    write_session(tmp_path, "P0001", files)
    folder = tmp_path / "sessions" / "P0001"
    name = data.draw(st.sampled_from(sorted(files)))
    size = data.draw(st.integers(-1, len(files[name]) - 1))
    if size < 0:
        (folder / name).unlink()
    else:
        (folder / name).write_bytes(files[name][:size])
    # The last byte of the manifest is a line break: without it, the manifest still says all.
    unharmed = name == "manifest.json" and size == len(files[name]) - 1
    assert is_whole(folder) == unharmed
    assert finished_sessions(tmp_path) == (("P0001",) if unharmed else ())
    if not unharmed:
        assert list(session_faults(folder))
        write_session(tmp_path, "P0001", files)
        assert _content(tmp_path / "sessions") == {f"P0001/{k}": v for k, v in files.items()}


def test_a_flipped_bit_is_found_by_its_checksum(tmp_path: Path, session_files: dict):
    """The same size with other content is a fault, as is a file that does not belong."""
    write_session(tmp_path, "P0001", session_files["P0001"])
    folder = tmp_path / "sessions" / "P0001"
    content = bytearray(session_files["P0001"]["steps-1.parquet"])
    content[100] ^= 1
    (folder / "steps-1.parquet").write_bytes(content)
    (folder / "notes.txt").write_text("mine")
    assert list(session_faults(folder)) == [
        f"{folder / 'steps-1.parquet'}: not what was written (its checksum differs)",
        f"{folder / 'notes.txt'}: not part of the session",
    ]


def test_a_foreign_manifest_is_none(tmp_path: Path):
    """Something else in the manifest's place is no manifest."""
    (tmp_path / "manifest.json").write_text('{"schema": 9, "files": {}, "versions": {}}')
    assert read_manifest(tmp_path) is None
    assert read_manifest(tmp_path / "nowhere") is None
