"""Sessions, by whoever runs them: this machine's cores, or a cluster's workers."""

import threading
import time
import traceback
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Protocol, TypeVar

from harness.processes import Died, Processes, warm_up
from protocols.errors import InputError

if TYPE_CHECKING:  # only: the workers' start must not wait for what reading a protocol needs
    from harness.plan import Plan
    from harness.world import World
    from protocols.course.schema import Course
    from protocols.start_noise import StartNoise
    from protocols.study import LaserSettings

T = TypeVar("T")

_ONE_AT_A_TIME = threading.Lock()
"""A process has one world; a Dask worker may have several threads."""


class Workers(Protocol):
    """Whoever runs a task for numbers, and yields each with its answer as soon as it is there."""

    def run(
        self, task: Callable[[int], T], numbers: Iterable[int]
    ) -> Iterator[tuple[int, T | Died]]:
        """Run; a task may be run again when its process died, and is answered once."""


@dataclass(frozen=True, slots=True)
class Finished:
    """A session as the bytes of its files.

    Attributes
    ----------
    files
        Name to content.
    wall_s
        How long it took, s.
    warned
        What Python warned of meanwhile.
    """

    files: dict[str, bytes]
    wall_s: float
    warned: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Failed:
    """A session that raised, with the traceback."""

    trace: str


def hire(jobs: int, scheduler: str | None = None) -> AbstractContextManager[Workers]:
    """Return the workers, for as long as a context lasts.

    Parameters
    ----------
    jobs
        Number of processes on this machine.
    scheduler
        Address of a Dask scheduler whose workers take their place.

    Raises
    ------
    InputError
        On entering: when there is no scheduler at the address, or Dask is not installed.
    """
    if scheduler is None:
        get_ready()
        return Processes(jobs)
    from harness.cluster import cluster  # noqa: PLC0415  # it names Dask, an extra

    return cluster(scheduler)


def get_ready() -> None:
    """Begin to start this machine's workers, in the background."""
    warm_up(["harness.session", "harness.world", "harness.cli"])


def rehearse(workers: Workers, plan: "Plan") -> None:
    """Make everybody of the first session once, so that a mistake shows before anything runs.

    Raises
    ------
    InputError
        When somebody the protocol names cannot be made where the sessions are going to run.
    ChildProcessError
        When a worker cannot even try.
    """
    for _, answer in workers.run(partial(_rehearsal, plan), [1]):
        if isinstance(answer, InputError):
            raise answer
        if isinstance(answer, Died) and not answer.again:
            raise ChildProcessError(f"no session can be run: {answer.reason}")


def run_sessions(
    workers: Workers, plan: "Plan", numbers: Iterable[int]
) -> Iterator[tuple[int, Finished | Failed | Died]]:
    """Run participants' sessions, and yield each as soon as it has ended.

    Never more than a few sessions per process are under way or waiting, so memory does not grow
    with the number of participants.
    """
    return workers.run(partial(attempt, plan), numbers)


def attempt(plan: "Plan", number: int) -> Finished | Failed | Died:
    """Run one session; whatever it raises, or ends by, ends this session only.

    Returns
    -------
    Finished | Failed | Died
        Died when no session at all can be run in this process: that is not the participant's
        failure, and the session may be tried in another process.
    """
    begun = time.perf_counter()
    with _ONE_AT_A_TIME, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("default")
        try:
            files = _session(plan, number)
        except BaseException:  # noqa: BLE001  # a driver's sys.exit() must not end a worker
            trace = traceback.format_exc()
            fault = _fault(plan, _world, _rehearse)
            return Failed(trace) if fault is None else Died(f"no session can be run there: {fault}")
    warned = tuple(f"{w.filename}:{w.lineno}: {w.category.__name__}: {w.message}" for w in caught)
    return Finished(files, time.perf_counter() - begun, warned)


def _session(plan: "Plan", number: int) -> dict[str, bytes]:
    from harness.session import Session  # noqa: PLC0415  # the runner itself needs no simulator
    from protocols.record.session import encode  # noqa: PLC0415

    return encode(Session(plan, number, _world(plan)).run(), plan.digest)


def _rehearsal(plan: "Plan", _number: int) -> InputError | None:
    return _fault(plan, _rehearse)


def _rehearse(plan: "Plan") -> None:
    from harness import casting  # noqa: PLC0415  # the runner itself needs no simulator

    casting.rehearse(plan)


def _fault(plan: "Plan", *preparations: Callable[["Plan"], object]) -> InputError | None:
    """Return why this process cannot prepare for any session; None when it can."""
    try:
        for prepare in preparations:
            prepare(plan)
    except InputError as error:
        return error
    except BaseException as error:  # noqa: BLE001  # somebody's own parts may fail in any way
        at = traceback.extract_tb(error.__traceback__)[-1]
        reason = f"{type(error).__name__}: {error} ({at.filename}:{at.lineno})"
        return InputError(f"{plan.study.protocol.name}: nobody can be made ready for it: {reason}")
    return None


def _world(plan: "Plan") -> "World":
    protocol = plan.study.protocol
    return _reused_world(
        plan.study.course, protocol.laser, protocol.control_period_s, protocol.start_noise
    )


@lru_cache(maxsize=1)
def _reused_world(
    course: "Course", laser: "LaserSettings", period: float, start_noise: "StartNoise"
) -> "World":
    """Return this process's world: building one costs more than resetting it."""
    from harness.world import BulletWorld  # noqa: PLC0415  # loads PyBullet

    return BulletWorld(course, laser=laser, period=period, start_noise=start_noise)
