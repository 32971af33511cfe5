"""Where our time goes: physics, rays, safeguard, driver, demonstrator, model, record.

The instrument wraps the methods of the very classes that run, in a pass of its own, never in the
timed one. What it takes itself, a fraction of a microsecond per call, counts as "rest".
"""

import gc
import statistics
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any
from unittest.mock import patch

import peers.shipped_lap
from peers.lad_study import LadStudy
from synthetic_course import synthetic_course

from harness.session.lap_log import LapLog
from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet import BulletChair
from harness.world.bullet_world import BulletWorld
from harness.world.laser import Laser
from harness.world.safeguard import Safeguard
from participants.autonomous import AutonomousDriver
from protocols.load import resolve_study
from protocols.record import session as record

REPETITIONS = 5

STAGES = ("physics", "rays", "safeguard", "driver", "demonstrator", "model", "record", "rest")

Wrapped = tuple[Any, str, str]
"""Who has the method, its name, and the stage it belongs to."""

WORLD: tuple[Wrapped, ...] = (
    *((BulletChair, name, "physics") for name in ("advance", "drive", "pose", "velocity")),
    (BulletChair, "touching", "physics"),
    (Laser, "scan", "rays"),
    (Safeguard, "guard", "safeguard"),
    (LapLog, "record", "record"),
    (LapLog, "table", "record"),
)


def print_splits(cell: tuple[int, int, int], seconds: float) -> None:
    """Print the split of the timed lap, and of a participant's whole session with the model.

    Parameters
    ----------
    cell
        Boxes, rays and control steps per second of the lap.
    seconds
        How long the lap is driven.
    """
    boxes, rays, rate_hz = cell
    simulator = LadStudy(synthetic_course(boxes), rays, rate_hz)
    lap = _split(
        lambda: simulator.drive_lap(seconds),
        (
            *WORLD,
            (AutonomousDriver, "act", "driver"),
            (peers.shipped_lap, "parquet_bytes", "record"),
        ),
    )
    simulator.close()
    print("\nWhere our CPU time goes, as shares\n")
    print(f"| | {' | '.join(STAGES)} | CPU s |")
    print(f"|---|{'---:|' * (len(STAGES) + 1)}")
    _print_row(f"whole lap, {boxes} boxes, {rays} rays, {rate_hz} Hz, {seconds:g} s", lap)
    _print_row("a session of four-lap, participant 1", _session())


def _session() -> Counter[str]:
    """Return the split of a participant's session, laps with demonstrator and model included."""
    run = StudyRun(resolve_study("four-lap"), 0)
    study = run.study
    people = make_parts(run, 1).lap
    world = BulletWorld(study.course, study.protocol.laser, study.protocol.control_period_s)
    split = _split(
        lambda: record.encode(Session(run, 1, world, make_parts(run, 1)).run()),
        (
            *WORLD,
            (type(people.driver), "act", "driver"),
            (type(people.demonstrator), "look", "demonstrator"),
            (type(people.demonstrator), "assist", "demonstrator"),
            (type(people.model), "assist", "model"),
            (type(people.model), "learn", "model"),
            (record, "encode", "record"),
        ),
    )
    world.close()
    return split


def _print_row(name: str, split: Counter[str]) -> None:
    shares = " | ".join(f"{split[stage] / split.total():.0%}" for stage in STAGES)
    print(f"| {name} | {shares} | {split.total():.2f} |")


def _split(run: Callable[[], object], wrapped: tuple[Wrapped, ...]) -> Counter[str]:
    """Return CPU seconds by stage: of the run whose total is the median."""
    run()
    splits = []
    for _ in range(REPETITIONS):
        gc.collect()
        with _watched(wrapped) as spent:
            begun = time.process_time()
            run()
            total = time.process_time() - begun
        splits.append(spent + Counter(rest=total - spent.total()))
    middle = statistics.median_low(split.total() for split in splits)
    return next(split for split in splits if split.total() == middle)


@contextmanager
def _watched(wrapped: tuple[Wrapped, ...]) -> Iterator[Counter[str]]:
    """Add up the seconds spent in methods; what one calls of another counts for the outer."""
    spent: Counter[str] = Counter()
    busy = False

    def watch(method: Callable[..., Any], stage: str) -> Callable[..., Any]:
        def watched(*args: Any, **kwargs: Any) -> Any:
            nonlocal busy
            if busy:
                return method(*args, **kwargs)
            busy = True
            begun = time.process_time()
            try:
                return method(*args, **kwargs)
            finally:
                spent[stage] += time.process_time() - begun  # type: ignore[assignment]
                busy = False

        return watched

    with ExitStack() as stack:
        for owner, name, stage in wrapped:
            method = watch(getattr(owner, name), stage)
            stack.enter_context(patch.object(owner, name, method))
        yield spent
