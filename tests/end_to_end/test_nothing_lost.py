"""Whatever ends a run, the same command finishes the study to the same bytes."""

import os
import random
import shutil
import signal
import time

import psutil
import pytest

KILLS = [2, pytest.param(25, marks=pytest.mark.slow)]
GAP_S = 0.2
"""About the time between two finished sessions."""


@pytest.fixture
def planned(undisturbed):
    """How many participants the study has."""
    return len({name.split("/")[1] for name in undisturbed if name.startswith("sessions/")})


@pytest.fixture
def at_a_random_moment(start_quick, wait_until, finished, planned, tmp_path):
    """Return the function that brings a new run to a moment between two finished sessions.

    It returns the run, stopped, so that nothing happens before the test has done its worst. A run
    that has finished its last session meanwhile is given up for another one.
    """

    def bring(moments):
        while True:
            shutil.rmtree(tmp_path / "study", ignore_errors=True)
            run = start_quick(tmp_path / "study", "--jobs", 2)
            wanted = moments.randint(1, planned - 1)
            wait_until(lambda: finished(tmp_path / "study") >= wanted)  # noqa: B023  # at once
            time.sleep(moments.uniform(0, GAP_S))
            if run.process.poll() is None:
                run.process.send_signal(signal.SIGSTOP)
                if finished(tmp_path / "study") < planned:
                    return run
            run.kill()

    return bring


@pytest.mark.parametrize("kills", KILLS)
def test_a_killed_run_is_finished_by_the_same_command(
    at_a_random_moment, run_quick, record, undisturbed, planned, tmp_path, kills
):
    """Kill -9 of the runner, alone or with its workers: no finished session is touched again."""
    out, moments = tmp_path / "study", random.Random(kills)  # noqa: S311  # no secret
    for _ in range(kills):
        run = at_a_random_moment(moments)
        if moments.random() < 0.5:
            os.killpg(run.process.pid, signal.SIGKILL)
        run.kill()
        finished = {n: c for n, c in record(out).items() if n.startswith("sessions/P")}
        assert not (out / "laps.parquet").exists()
        ended = run_quick(out, "--jobs", 2)
        assert ended.code == 0, ended.err
        sessions = {name.split("/")[1] for name in finished}
        assert f"{len(sessions)} of {planned} sessions were there already." in ended.out
        whole = record(out)
        assert finished.items() <= whole.items()
        assert whole == undisturbed


@pytest.mark.parametrize("kills", KILLS)
@pytest.mark.slow
def test_a_run_survives_the_death_of_a_worker(
    at_a_random_moment, record, undisturbed, tmp_path, kills
):
    """Kill -9 of a worker at a random moment: the run continues, and ends with the same bytes."""
    out, moments = tmp_path / "study", random.Random(kills)  # noqa: S311  # no secret
    for _ in range(kills):
        run = at_a_random_moment(moments)
        moments.choice(run.workers()).kill()
        run.process.send_signal(signal.SIGCONT)
        ended = run.ended()
        assert ended.code == 0, ended.err
        assert "Traceback" not in ended.err
        assert record(out) == undisturbed


def test_a_killed_session_is_logged(at_a_random_moment, record, undisturbed, tmp_path):
    """When every worker is killed at once, the log names who had to be run again."""
    run = at_a_random_moment(random.Random(1))  # noqa: S311  # no secret
    for worker in run.workers():
        worker.kill()
    run.process.send_signal(signal.SIGCONT)
    assert run.ended().code == 0
    assert "killed by SIGKILL" in (tmp_path / "study" / "logs" / "deaths.csv").read_text()
    assert record(tmp_path / "study") == undisturbed


def test_ctrl_c_ends_a_run_in_one_line(
    start_quick, wait_until, finished, run_quick, record, undisturbed, tmp_path
):
    """Exit code 1, no traceback, no process left; the same command resumes the run."""
    out = tmp_path / "study"
    run = start_quick(out, "--jobs", 2)
    wait_until(lambda: finished(out) >= 1)
    processes = run.descendants()
    run.interrupt()
    ended = run.ended()
    assert ended.code == 1
    said = [line for line in ended.err.splitlines() if not line.startswith("Sessions ")]
    assert said == ["lad-study: stopped. What was finished is kept."]
    assert psutil.wait_procs(processes, timeout=30)[1] == []
    assert not (out / "laps.parquet").exists()
    assert run_quick(out).code == 0
    assert record(out) == undisturbed


@pytest.mark.slow
def test_a_write_error_ends_a_run_in_one_line(run_quick, record, undisturbed, tmp_path):
    """The system's reason and the file are said; what was finished is kept; no file is half."""
    out = tmp_path / "study"
    assert run_quick(out, "--participants", 2).code == 0
    ended = run_quick(out, largest_file=100_000)
    assert ended.code == 1
    said = [line for line in ended.err.splitlines() if not line.startswith("Sessions ")]
    assert len(said) == 1
    assert "File too large" in said[0]
    assert str(out) in said[0]
    assert sorted(p.name for p in (out / "sessions").iterdir()) == ["P0001", "P0002"]
    assert run_quick(out).code == 0
    assert record(out) == undisturbed
