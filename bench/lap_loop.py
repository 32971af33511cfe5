"""Simulated seconds per CPU second of our loop and of its peers, doing the same in one run.

    python bench/lap_loop.py                  everything, about ten minutes
    python bench/lap_loop.py --quick          60 boxes, 180 rays, 20 Hz only
    python bench/lap_loop.py --json rows.json

Two parts are timed. ``sensing+stepping``: observe, follow the path by pure pursuit, move, with the
wheelchair physics and the lidar that are shipped, and nothing else. ``whole lap``: the first
seconds of a lap by the autonomous driver, with limitation, safeguard and record, its table and
its file included. The simulators take turns in every repetition; what is printed are medians of
CPU time, one thread each.
"""

import argparse
import gc
import itertools
import json
import math
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, astuple, dataclass
from importlib import import_module
from pathlib import Path

import single_thread  # noqa: F401  # before anything that imports numpy
from lap_loop_plot import plot
from peers.simulator import Simulator
from pursuit import Pursuit
from ray_cost import print_ray_cost
from synthetic_course import synthetic_course
from time_split import print_splits

from protocols.course.centreline import Centreline
from protocols.course.schema import Course
from protocols.wheelchair import ACCELERATION, MAX_SPEED

OURS = "lad-study"

SIMULATORS = {
    OURS: "lad_study:LadStudy",
    "naive pybullet": "naive_pybullet:NaivePyBullet",
    "ir-sim": "ir_sim:IRSim",
    "mujoco": "mujoco_wheels:MuJoCo",
    "navground": "navground_world:Navground",
}

PARTS = ("sensing+stepping", "whole lap")

SECONDS = {"sensing+stepping": 4.0, "whole lap": 12.0}
"""What one stretch simulates."""

SHORTEST_TURN = 0.15
"""A simulator repeats its stretch until so much CPU time has passed, s."""

FIGURE = Path(__file__).parent.parent / "docs" / "figures" / "lap_loop.svg"


@dataclass(frozen=True, order=True)
class Cell:
    """A size of the problem."""

    boxes: int
    rays: int
    rate_hz: int


REFERENCE = Cell(60, 180, 20)
GRID = tuple(itertools.starmap(Cell, itertools.product((20, 60, 200), (15, 180, 682), (10, 20))))


@dataclass(frozen=True)
class Row:
    """One result: simulated seconds per CPU second."""

    simulator: str
    boxes: int
    rays: int
    rate_hz: int
    part: str
    rtf: float


Factory = Callable[[Course, int, int], Simulator]


def find_simulators() -> dict[str, Factory]:
    """Return those simulators that are installed; print which are not."""
    found = {}
    for name, where in SIMULATORS.items():
        module, _, factory = where.partition(":")
        try:
            found[name] = getattr(import_module(f"peers.{module}"), factory)
        except ImportError as error:
            print(f"{name}: absent ({error})")
    return found


def sense_and_step(simulator: Simulator, pursuit: Pursuit, steps: int) -> None:
    """Observe, steer, move."""
    for _ in range(steps):
        pose, _ = simulator.sense()
        simulator.step(pursuit.act(pose))


def check(name: str, simulator: Simulator, course: Course, rate_hz: int) -> None:
    """Make sure that a simulator follows the path at full speed; warms it up, too."""
    line, pursuit, seconds = Centreline(course), Pursuit(course), 10
    simulator.restart()
    before, _ = simulator.sense()
    way = worst = 0.0
    for _ in range(seconds * rate_hz):
        sense_and_step(simulator, pursuit, 1)
        pose, ranges = simulator.sense()
        way += math.dist(before[:2], pose[:2])
        worst = max(worst, abs(line.locate(pose.x, pose.y)[1]))
        before = pose
        if not 0.0 <= ranges.min() <= ranges.max() <= 4.0:
            raise AssertionError(f"{name}: ranges from {ranges.min()} to {ranges.max()} m")
    # At best it is at once at full speed; at worst it speeds up as the chair does, and cuts bends.
    most = MAX_SPEED * seconds
    least = 0.97 * (most - MAX_SPEED**2 / (2 * ACCELERATION))
    if not least < way < 1.01 * most or worst > 0.15:
        raise AssertionError(f"{name}: drove {way:.2f} m, up to {worst:.2f} m beside the path")
    simulator.drive_lap(1.0)


def measure(cell: Cell, factories: dict[str, Factory], repetitions: int) -> Iterator[Row]:
    """Time every simulator in one cell, taking turns."""
    course = synthetic_course(cell.boxes)
    there = {name: make(course, cell.rays, cell.rate_hz) for name, make in factories.items()}
    for name, simulator in there.items():
        check(name, simulator, course, cell.rate_hz)
    for part in PARTS:
        rtf: dict[str, list[float]] = {name: [] for name in there}
        for _ in range(repetitions):
            for name, simulator in there.items():
                rtf[name].append(_timed(simulator, course, cell, part))
        for name, values in rtf.items():
            yield Row(name, **asdict(cell), part=part, rtf=statistics.median(values))
    for simulator in there.values():
        simulator.close()


def _timed(simulator: Simulator, course: Course, cell: Cell, part: str) -> float:
    """Return simulated seconds per CPU second of one turn."""
    simulated = spent = 0.0
    while spent < SHORTEST_TURN:
        pursuit = Pursuit(course)
        simulator.restart()
        gc.collect()
        begun = time.process_time()
        if part == "whole lap":
            simulated += simulator.drive_lap(SECONDS[part])
        else:
            sense_and_step(simulator, pursuit, round(SECONDS[part] * cell.rate_hz))
            simulated += SECONDS[part]
        spent += time.process_time() - begun
    return simulated / spent


def print_table(rows: list[Row], part: str) -> None:
    """Print a part's results as a Markdown table: RTF, and in brackets how often ours is that."""
    names = list(dict.fromkeys(row.simulator for row in rows))
    results = {(row.simulator, row.boxes, row.rays, row.rate_hz): row.rtf
               for row in rows if row.part == part}  # fmt: skip
    print(f"\n{part}: simulated seconds per CPU second (in brackets: ours / theirs)\n")
    print(f"| boxes | rays | Hz | {' | '.join(names)} |")
    print(f"|{'---:|' * (3 + len(names))}")
    for boxes, rays, rate_hz in sorted({key[1:] for key in results}):
        ours = results[OURS, boxes, rays, rate_hz]
        cells = [f"**{ours:.0f}**"]
        for name in names[1:]:
            theirs = results[name, boxes, rays, rate_hz]
            cells.append(f"{theirs:.0f} ({ours / theirs:.1f})")
        print(f"| {boxes} | {rays} | {rate_hz} | {' | '.join(cells)} |")


def main() -> None:
    """Measure, print, and write what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="60 boxes, 180 rays, 20 Hz only")
    parser.add_argument("--repetitions", type=int, default=None, help="of every measurement")
    parser.add_argument("--json", type=Path, help="file for the rows")
    parser.add_argument("--plot", type=Path, help="file for the plot; not drawn by --quick alone")
    arguments = parser.parse_args()
    factories = find_simulators()
    rows: list[Row] = []
    for cell in (REFERENCE,) if arguments.quick else GRID:
        repetitions = arguments.repetitions or (7 if cell == REFERENCE else 3)
        rows += measure(cell, factories, repetitions)
        print(f"{cell.boxes} boxes, {cell.rays} rays, {cell.rate_hz} Hz done", file=sys.stderr)
    if arguments.json:
        arguments.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n")
    if arguments.plot or not arguments.quick:
        plot([asdict(row) for row in rows], arguments.plot or FIGURE)
    for part in PARTS:
        print_table(rows, part)
    print_ray_cost(REFERENCE.rays)
    print_splits(astuple(REFERENCE), SECONDS["whole lap"])


if __name__ == "__main__":
    main()
