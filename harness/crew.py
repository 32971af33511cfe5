"""Sessions on every core, or on a cluster: participants run to completion, each in one process."""

import time
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache

import joblib

from harness.cluster import dask_client
from harness.plan import Plan
from harness.session import Session
from harness.world import BulletWorld
from protocols.course.schema import Course
from protocols.record.session import encode
from protocols.study import LaserSettings


@dataclass(frozen=True, slots=True)
class Finished:
    """A session as the bytes of its files, and the seconds it took."""

    number: int
    files: dict[str, bytes]
    wall_s: float


@dataclass(frozen=True, slots=True)
class Failed:
    """A session that raised, with the traceback."""

    number: int
    trace: str


def run_sessions(
    plan: Plan, numbers: Sequence[int], jobs: int, scheduler: str | None = None
) -> Iterator[Finished | Failed]:
    """Run participants' sessions, and yield each as soon as it has ended.

    Never more than a few sessions per process are under way or waiting, so memory does not grow
    with the number of participants.

    Parameters
    ----------
    plan
        The study and its seed.
    numbers
        The participants to run.
    jobs
        Number of processes on this machine; 1 stays in this one.
    scheduler
        Address of a Dask scheduler whose workers run the sessions instead.

    Raises
    ------
    InputError
        When there is no scheduler at the address, or Dask is not installed.
    """
    if scheduler is None and (jobs == 1 or len(numbers) <= 1):
        yield from (_attempt(plan, number) for number in numbers)
        return
    with _backend(scheduler):
        crew = joblib.Parallel(
            n_jobs=-1 if scheduler else min(jobs, len(numbers)),
            return_as="generator_unordered",
            pre_dispatch="3*n_jobs",
            batch_size=1,
        )
        yield from crew(joblib.delayed(_attempt)(plan, number) for number in numbers)


@contextmanager
def _backend(scheduler: str | None) -> Iterator[None]:
    """Choose who runs the sessions: this machine's cores, or a cluster's workers."""
    if scheduler is None:
        with joblib.parallel_config(backend="loky", inner_max_num_threads=1):
            yield
        return
    with dask_client(scheduler), joblib.parallel_config(backend="dask"):
        yield


def _attempt(plan: Plan, number: int) -> Finished | Failed:
    """Run one session; whatever it raises ends this session only."""
    begun = time.perf_counter()
    try:
        protocol = plan.study.protocol
        world = _world(plan.study.course, protocol.laser, protocol.control_period_s)
        files = encode(Session(plan, number, world).run())
    except Exception:  # noqa: BLE001  # one participant's failure must not end the others'
        return Failed(number, traceback.format_exc())
    return Finished(number, files, time.perf_counter() - begun)


@lru_cache(maxsize=1)
def _world(course: Course, laser: LaserSettings, period: float) -> BulletWorld:
    """Return this process's world: building one costs more than resetting it."""
    return BulletWorld(course, laser=laser, period=period)
