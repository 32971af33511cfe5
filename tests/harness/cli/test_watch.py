"""How far a running study is."""

import subprocess
import sys

import pytest

from harness.running.runner import run_study
from protocols.record.folder import lock_taken_at, locked
from protocols.record.logs import write_failure
from protocols.record.standing import standing


@pytest.fixture
def folder(make_run, ready, tmp_path):
    """Return a study of three short sessions, one of which is said to have failed."""
    run_study(make_run(participants=3), tmp_path / "study", 1)
    write_failure(tmp_path / "study", "P0009", "Traceback")
    return tmp_path / "study"


def test_sessions_laps_and_failures_are_counted(lad_study, folder):
    """As they lie in the directory, without a run; nothing is waited for."""
    said = lad_study("watch", folder, "--once")
    assert said.code == 0
    assert said.out.splitlines() == [
        "3 of 3 sessions; 3 laps, 3 unfinished; 1 failed: P0009",
        "No run is writing into it.",
    ]


def test_watching_ends_when_the_run_does(folder, monkeypatch, lad_study):
    """While another process holds the directory it goes on, and the run is not disturbed."""
    hold = (
        "import sys; from pathlib import Path; from protocols.record.folder import locked\n"
        f"with locked(Path({str(folder)!r})): print('held', flush=True); sys.stdin.read()"
    )
    command = [sys.executable, "-c", hold]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(command, **pipes) as run:  # noqa: S603  # our own code
        run.stdout.readline()
        now = standing(folder)
        assert now.since_s is not None
        assert now.done_since == 0
        # The first wait of the command lets the run end.
        monkeypatch.setattr("harness.cli.watch.time.sleep", lambda _: run.communicate(b""))
        said = lad_study("watch", folder)
    assert said.out.splitlines()[-1] == "No run is writing into it."
    assert run.returncode == 0


def test_looking_at_the_lock_leaves_it_free(folder):
    """A run can begin after somebody has looked."""
    assert lock_taken_at(folder) is None
    with locked(folder):
        assert lock_taken_at(folder) is not None


def test_what_is_no_study_is_an_input_fault(lad_study):
    """Exit code 2 and one line."""
    said = lad_study("watch", "nowhere")
    assert (said.code, said.err) == (2, "nowhere: no such folder\n")
