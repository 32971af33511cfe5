"""How a run scales: cores against wall time, and a thousand participants against memory.

    python bench/scale.py cores --participants 12 48 --jobs 1 2 --repeats 3
    python bench/scale.py cohort --participants 1000 --out DIR
    python bench/scale.py writer --sessions 150 --out DIR

The first runs whole studies by the command line, interleaved, and prints the median wall time and
the speedup over one process. The second runs one study and its report while it watches their
memory. The third writes one session over and over as the runner of a cluster does. All write their
rows with --json FILE. The tables in docs/scale.md were made with it.
"""

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd
import psutil

from harness.running.workers import Finished
from harness.running.writer import AT_ONCE, Writer

COMMAND = (sys.executable, "-c", "from harness.cli import main; main()")
EVERY_S = 0.5
"""How often memory is looked at."""
MB = 1e6


def main() -> None:
    """Measure what the arguments ask for, and print it as a table."""
    arguments = _arguments()
    rows = arguments.measure(arguments)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")


def cores(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    """Run studies of every size with every number of processes, in turn.

    Two speedups: of the whole command, start and tables included, and of the sessions alone,
    which is the number of processes over how much longer a session takes beside the others.
    """
    walls: dict[tuple[int, int], list[float]] = {}
    sessions: dict[tuple[int, int], list[float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(arguments.repeats):
            for participants in arguments.participants:
                for jobs in arguments.jobs:
                    out = Path(folder) / "study"
                    begun = time.perf_counter()
                    command = _run(arguments, participants, jobs, out)
                    subprocess.run(command, check=True)  # noqa: S603  # our own command
                    walls.setdefault((participants, jobs), []).append(time.perf_counter() - begun)
                    took = pd.read_csv(out / "logs" / "timing.csv")["wall_s"].mean()
                    sessions.setdefault((participants, jobs), []).append(float(took))
                    shutil.rmtree(out)
    print(f"{'participants':>12} {'jobs':>5} {'wall s':>8} {'speedup':>8} {'a session s':>12} "
          f"{'speedup':>8}")  # fmt: skip
    rows = []
    for (participants, jobs), seconds in walls.items():
        first = participants, arguments.jobs[0]
        wall, alone = statistics.median(seconds), statistics.median(sessions[participants, jobs])
        whole = statistics.median(walls[first]) / wall
        parts = jobs / first[1] * statistics.median(sessions[first]) / alone
        rows.append({"participants": participants, "jobs": jobs, "wall_s": wall, "speedup": whole,
                     "session_s": alone, "speedup_of_sessions": parts,
                     "all_wall_s": seconds})  # fmt: skip
        print(f"{participants:12d} {jobs:5d} {wall:8.2f} {whole:8.2f} {alone:12.2f} {parts:8.2f}")
    return rows


def cohort(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    """Run one study, then its report, and watch both."""
    (participants,), out = arguments.participants, arguments.out
    command = _run(arguments, participants, arguments.jobs[-1], out)
    wall, memory = _watched(command, lambda: len(list((out / "sessions").glob("P*"))))
    rows: list[dict[str, Any]] = [
        {"part": "run", "wall_s": wall, "sessions_per_minute": 60 * participants / wall,
         "runner_peak_mb": max(look.own_mb for look in memory),
         "all_peak_mb": max(look.all_mb for look in memory),
         "largest_worker_peak_mb": max(look.largest_child_mb for look in memory),
         "size_mb": _size(out), "runner_mb_by_sessions": _thinned(memory)}
    ]  # fmt: skip
    wall, memory = _watched((*COMMAND, "report", str(out)), lambda: 0)
    rows.append({"part": "report", "wall_s": wall,
                 "peak_mb": max(look.all_mb for look in memory)})  # fmt: skip
    for row in rows:
        print(row.pop("part"), *(f"  {name}: {_shown(value)}" for name, value in row.items()),
              sep="\n")  # fmt: skip
    return rows


def writer(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    """Feed the runner's writer with one recorded session over and over, as a cluster would.

    Sessions are written one at a time, as they were before, and several at once; both in turn, on
    the disk of ``--out``.
    """
    rate: dict[int, list[float]] = {1: [], AT_ONCE: []}
    with tempfile.TemporaryDirectory(dir=arguments.out.parent) as folder:
        run = _run(arguments, 1, 1, Path(folder) / "one")
        subprocess.run(run, check=True)  # noqa: S603  # our own command
        source = Path(folder) / "one" / "sessions" / "P0001"
        files = {path.name: path.read_bytes() for path in source.iterdir()}
        for _ in range(arguments.repeats):
            for at_once, rates in rate.items():
                out = Path(folder) / "study"
                begun = time.perf_counter()
                with Writer(out, at_once) as one:
                    for number in range(arguments.sessions):
                        one.write(f"P{number + 1:04d}", Finished(files, 1.0))
                    one.wait()
                rates.append(arguments.sessions / (time.perf_counter() - begun))
                shutil.rmtree(out)
    size = sum(map(len, files.values())) / MB
    print(f"{arguments.sessions} sessions of {size:.1f} MB in {len(files)} files")
    rows = []
    for at_once, rates in rate.items():
        print(f"{at_once} at a time: {statistics.median(rates):.0f} sessions a second "
              f"({min(rates):.0f} to {max(rates):.0f})")  # fmt: skip
        rows.append({"at_once": at_once, "sessions_per_s": statistics.median(rates), "all": rates})
    return rows


class _Look(NamedTuple):
    """Memory at one moment; pages that processes share count once, a part in each of them."""

    counted: int
    own_mb: float
    all_mb: float
    largest_child_mb: float


def _watched(command: Sequence[str], count: Callable[[], int]) -> tuple[float, list[_Look]]:
    """Return a command's wall time, and memory by what had been counted meanwhile."""
    begun = time.perf_counter()
    running = subprocess.Popen(command)  # noqa: S603  # our own command
    process, memory = psutil.Process(running.pid), []
    while running.poll() is None:
        own = _memory(process)
        children = [_memory(child) for child in process.children(recursive=True)]
        memory.append(_Look(count(), own, own + sum(children), max(children, default=0.0)))
        time.sleep(EVERY_S)
    if running.returncode:
        raise SystemExit(f"{' '.join(command)} ended with exit code {running.returncode}")
    return time.perf_counter() - begun, memory


def _memory(process: psutil.Process) -> float:
    try:
        return float(process.memory_full_info().pss) / MB
    except (psutil.NoSuchProcess, psutil.AccessDenied):
        return 0.0


def _thinned(memory: Sequence[_Look]) -> dict[int, float]:
    """Return the memory at about ten numbers of finished sessions."""
    last = max(look.counted for look in memory)
    at: dict[int, float] = {}
    for look in memory:
        mark = round(10 * look.counted / max(1, last)) * last // 10
        at[mark] = max(at.get(mark, 0.0), look.own_mb)
    return at


def _size(folder: Path) -> float:
    return sum(_sizes(folder)) / MB


def _sizes(folder: Path) -> Iterator[int]:
    return (path.stat().st_size for path in folder.rglob("*") if path.is_file())


def _shown(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key}: {_shown(inner)}" for key, inner in value.items())
    return f"{value:.1f}" if isinstance(value, float) else str(value)


def _run(arguments: argparse.Namespace, participants: int, jobs: int, out: Path) -> list[str]:
    options = ("--participants", participants, "--jobs", jobs, "--out", out)
    return [*COMMAND, "run", arguments.protocol, "--no-report", *map(str, options)]


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("what", choices=("cores", "cohort", "writer"))
    parser.add_argument("--participants", type=int, nargs="+", default=[12, 48])
    parser.add_argument("--jobs", type=int, nargs="+", default=[1, os.cpu_count() or 1])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--sessions", type=int, default=150)
    parser.add_argument("--protocol", default="four-lap")
    parser.add_argument("--out", type=Path, default=Path("studies/cohort"))
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    arguments.measure = {"cores": cores, "cohort": cohort, "writer": writer}[arguments.what]
    if arguments.what == "cohort" and len(arguments.participants) != 1:
        parser.error("cohort takes one number of participants")
    return arguments


if __name__ == "__main__":
    main()
