"""Add a line to bench/history.csv: what the code of this commit costs, as ratios.

    make bench

Seconds depend on the machine and on what shares its cores. So each figure is CPU time over the CPU
time of something beside it that our code cannot change, both taken in turns:

``session``
    A participant's four-lap session, its record encoded, over the bare physics steps in it.
``report``
    The report of three participants over the same physics steps.
``gp_200``, ``gp_400``, ``gp_800``
    A learning step with deletion over its physical limit, two dsymv and two dsyr of that size.

A line that is a tenth above the one before it, on the same machine, asks for a reason.
"""

import csv
import gc
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pybullet
from stork_gp import (
    TIMED_STEPS,
    TRAINING_STEPS,
    bound_steps,
    measure,
    online_step,
    processor,
    stream,
)

from analysis.report import write_report
from harness.running.runner import run_study
from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from protocols.load import resolve_study
from protocols.record.session import encode

HISTORY = Path(__file__).with_name("history.csv")
ROUNDS = 5
GP_ROUNDS = 15
SIZES = (200, 400, 800)
COLUMNS = ("date", "commit", "machine", "python", "session", "report", *(f"gp_{m}" for m in SIZES))


def main() -> None:
    """Measure, print the line and append it."""
    figures = {**session_and_report(), **learning_steps()}
    row = {
        "date": time.strftime("%Y-%m-%d", time.gmtime()),
        "commit": commit(),
        "machine": processor(),
        "python": platform.python_version(),
        **{name: f"{value:.3f}" for name, value in figures.items()},
    }
    is_new = not HISTORY.exists()
    with HISTORY.open("a", newline="", encoding="utf-8") as file:
        lines = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        if is_new:
            lines.writeheader()
        lines.writerow(row)
    print(*(f"{name}: {value}" for name, value in row.items()), sep="\n")


def session_and_report() -> dict[str, float]:
    """Return the medians of session and report over physics."""
    run = StudyRun(resolve_study("four-lap", participants=3), 0)
    study = run.study
    world = BulletWorld(study.course, study.protocol.laser, study.protocol.control_period_s)

    def session() -> int:
        done = Session(run, 1, world, make_parts(run, 1)).run()
        encode(done)
        return sum(lap.row.steps for lap in done.laps)

    per_control_step = round(study.protocol.control_period_s * 60)
    physics_steps = per_control_step * session()
    client = world._chair._client  # noqa: SLF001  # the bare engine is what is compared with

    def physics() -> None:
        for _ in range(physics_steps):
            pybullet.stepSimulation(client)

    with tempfile.TemporaryDirectory() as folder:
        run_study(run, Path(folder) / "study", 1)

        def report() -> None:
            write_report(Path(folder) / "study")

        report()
        rounds = [(cpu(physics), cpu(session), cpu(report)) for _ in range(ROUNDS)]
    world.close()
    return {
        "session": statistics.median(one / base for base, one, _ in rounds),
        "report": statistics.median(one / base for base, _, one in rounds),
    }


def cpu(work: Callable[[], object]) -> float:
    """Return the CPU seconds that some work takes."""
    gc.collect()
    begun = time.process_time()
    work()
    return time.process_time() - begun


def learning_steps() -> dict[str, float]:
    """Return the learning step with deletion, tau = 4, over its limit at each size."""
    data, found = stream(TRAINING_STEPS + TIMED_STEPS), {}
    for m in SIZES:
        name = "full+delete"
        steps = {"lad": online_step("lad", name, m, 4, data), "bound": bound_steps(m)[name]}
        times = measure(steps, GP_ROUNDS)
        found[f"gp_{m}"] = times["lad"] / times["bound"]
    return found


def commit() -> str:
    """Return this checkout's commit, with a plus when something in it is changed."""
    changed = _git("status", "--porcelain", "-uno")
    return _git("rev-parse", "--short", "HEAD") + ("+" if changed else "")


def _git(*command: str) -> str:
    git = ["git", "-C", str(HISTORY.parent), *command]
    return subprocess.run(git, capture_output=True, text=True, check=True).stdout.strip()  # noqa: S603


if __name__ == "__main__":
    sys.exit(main())
