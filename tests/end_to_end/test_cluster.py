"""A study on a real Dask cluster: what happens to workers changes no byte."""

import csv
import json
import os
import signal
import socket
import subprocess
import sys

import pytest

from protocols.record.check import check_study

pytest.importorskip("distributed")

ODD = """\
schema: 1
name: odd
title: A driver of one's own
cohort: {{participants: 8, driver: {{use: 'odd_driver:patient', options: {{go: '{go}'}}}}}}
conditions:
  baseline: {{}}
laps:
  - {{condition: baseline, time_limit_s: 3}}
"""

DRIVER = """\
import time
from pathlib import Path
import joystick_of_ours
from lad.command import Command

class Patient:
    def __init__(self, go): self.go = go
    def start_lap(self, lap, rng):
        while not self.go.exists(): time.sleep(0.01)
    def act(self, sight): return Command(0.2, 0.0)

def patient(setup): return Patient(Path(setup.options["go"]))
"""


@pytest.fixture
def dask(tmp_path, packages):
    """Return the function that starts one of Dask's commands, with what it says in a file."""
    started = []

    def begin(command, *arguments, path=packages):
        log = tmp_path / f"{len(started)}.log"
        with log.open("w") as out:
            process = subprocess.Popen(  # noqa: S603  # Dask's own command
                [sys.executable, "-m", f"distributed.cli.dask_{command}", *map(str, arguments)],
                cwd=tmp_path,
                env={**os.environ, "PYTHONPATH": str(path)},
                stdout=out,
                stderr=out,
                start_new_session=True,
            )
        started.append(process)
        return process, log

    yield begin
    for process in started:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@pytest.fixture
def scheduler(dask, tmp_path, wait_until):
    """Return a scheduler's process and address."""
    file = tmp_path / "scheduler.json"
    process, _ = dask(
        "scheduler", "--host", "127.0.0.1", "--port", 0, "--no-dashboard",
        "--scheduler-file", file,
    )  # fmt: skip
    wait_until(lambda: file.exists() and file.stat().st_size)
    return process, json.loads(file.read_text())["address"]


@pytest.fixture
def add_worker(dask, scheduler, wait_until, packages):
    """Return the function that adds a worker process to the cluster."""

    def add(threads, *folders, first=None):
        before = [] if first is None else [first]
        path = os.pathsep.join(map(str, [*before, packages, *folders]))
        process, log = dask(
            "worker", scheduler[1], "--no-nanny", "--no-dashboard", "--nthreads", threads,
            path=path,
        )  # fmt: skip
        wait_until(lambda: "Registered to" in log.read_text())
        return process

    return add


@pytest.mark.slow
def test_a_study_survives_the_death_of_a_worker(
    scheduler, add_worker, start_quick, wait_until, finished, record, undisturbed, tmp_path
):
    """Every participant is there once, with the bytes of a local run.

    The other worker has two threads: its sessions must not share a world.
    """
    out, doomed = tmp_path / "study", add_worker(1)
    add_worker(2)
    run = start_quick(out, "--scheduler", scheduler[1])
    wait_until(lambda: finished(out) >= 1)
    assert finished(out) < len({n.split("/")[1] for n in undisturbed if "sessions/" in n})
    doomed.kill()
    ended = run.ended()
    assert ended.code == 0, ended.err
    assert "Traceback" not in ended.err
    assert record(out) == undisturbed
    assert check_study(out) == ()


@pytest.mark.slow
def test_a_machine_that_lacks_something_leaves(scheduler, add_worker, start, wait_until, tmp_path):
    """Its sessions are run elsewhere, and the log says which machine it was and what it lacks."""
    out, go, folder = tmp_path / "study", tmp_path / "go", tmp_path / "drivers"
    folder.mkdir()
    (folder / "joystick_of_ours.py").write_text("")
    (tmp_path / "odd_driver.py").write_text(DRIVER)
    (tmp_path / "odd.yaml").write_text(ODD.format(go=go))
    add_worker(1, folder)
    run = start(
        "run", "odd.yaml", "--trust", "--no-report", "--out", out, "--scheduler", scheduler[1],
        XDG_STATE_HOME=str(tmp_path / "state"),
    )  # fmt: skip
    wait_until((out / "study.yaml").exists)
    doomed = add_worker(2)
    go.touch()
    ended = run.ended()
    assert "Nobody finished a lap of baseline (8 begun)" in ended.err, ended.err
    assert check_study(out) == ()
    doomed.wait(60)
    for death in csv.DictReader((out / "logs" / "deaths.csv").read_text().splitlines()):
        assert death["reason"].startswith(f"on {socket.gethostname()}: ")
        assert "No module named 'joystick_of_ours'" in death["reason"]


def test_a_cluster_whose_only_worker_lacks_the_package_is_refused(
    scheduler, add_worker, start_quick, tmp_path
):
    """The machine and what it lacks are named within seconds, and nothing is written."""
    (tmp_path / "bare" / "harness").mkdir(parents=True)
    says = "raise ModuleNotFoundError(\"No module named 'harness'\", name='harness')\n"
    (tmp_path / "bare" / "harness" / "__init__.py").write_text(says)
    add_worker(1, first=tmp_path / "bare")
    ended = start_quick(tmp_path / "study", "--scheduler", scheduler[1]).ended()
    assert ended.code == 1
    assert ended.err.count("\n") == 1
    assert f"on {socket.gethostname()}: ModuleNotFoundError: No module named 'harness'" in ended.err
    assert not (tmp_path / "study").exists()


@pytest.mark.slow
def test_a_run_without_a_worker_says_so_and_waits(
    scheduler, add_worker, start_quick, wait_until, finished, record, undisturbed, tmp_path
):
    """With the next worker it resumes, to the same bytes."""
    out, only = tmp_path / "study", add_worker(1)
    run = start_quick(out, "--scheduler", scheduler[1])
    wait_until(lambda: finished(out) >= 1)
    only.kill()
    said = next(line for line in run.process.stderr if not line.startswith("Sessions "))
    assert said.startswith(f"no worker is left at {scheduler[1]}: waiting for one")
    add_worker(1)
    assert run.ended().code == 0
    assert record(out) == undisturbed


@pytest.mark.slow
def test_a_lost_scheduler_ends_a_run_in_one_line(
    scheduler, add_worker, start_quick, wait_until, finished, run_quick, record, undisturbed,
    tmp_path,
):  # fmt: skip
    """What was finished is kept, and the same study resumes without the cluster."""
    out = tmp_path / "study"
    add_worker(1)
    run = start_quick(out, "--scheduler", scheduler[1])
    wait_until(lambda: finished(out) >= 1)
    scheduler[0].kill()
    ended = run.ended()
    assert ended.code == 1
    said = [line for line in ended.err.splitlines() if not line.startswith("Sessions ")]
    assert said == ["lad-study: the Dask scheduler was lost; the same command resumes the run"]
    assert run_quick(out).code == 0
    assert record(out) == undisturbed
