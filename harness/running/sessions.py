"""Sessions as tasks: what a worker process does for one participant."""

import threading
import time
import traceback
import warnings
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from harness.running.workers import Died, Failed, Finished, Workers
from protocols.files.errors import InputError

if TYPE_CHECKING:  # only for types: the workers start without the modules that read a protocol
    from harness.session.study_run import StudyRun
    from harness.world.world import World
    from protocols.course.schema import Course
    from protocols.start_noise import StartNoise
    from protocols.study import LaserSettings

_ONE_AT_A_TIME = threading.Lock()
"""A process has one world; a Dask worker may have several threads."""


def try_parts(workers: Workers, run: "StudyRun") -> None:
    """Make the parts of the first session once, so that a mistake shows before anything runs.

    Raises
    ------
    InputError
        When a part that the protocol names cannot be made where the sessions are going to run.
    ChildProcessError
        When no worker can try it.
    """
    for _, answer in workers.run(partial(_part_fault, run), [1]):
        if isinstance(answer, InputError):
            raise answer
        if isinstance(answer, Died) and (answer.unfit or not answer.retried):
            raise ChildProcessError(f"no session can be run: {answer.reason}")


def run_sessions(
    workers: Workers, run: "StudyRun", numbers: Iterable[int]
) -> Iterator[tuple[int, Finished | Failed | Died]]:
    """Run participants' sessions, and yield each as soon as it has ended.

    Never more than a few sessions per process are under way or waiting, so memory does not grow
    with the number of participants.
    """
    return workers.run(partial(attempt, run), numbers)


def attempt(run: "StudyRun", number: int) -> Finished | Failed | Died:
    """Run one session; an error or exit in it ends this session only.

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
            files = _session(run, number)
        except BaseException:  # noqa: BLE001  # a driver's sys.exit() must not end a worker
            trace = traceback.format_exc()
            fault = _fault(run, world_of, _make_parts)
            return Failed(trace) if fault is None else Died(f"no session can be run there: {fault}")
    warned = tuple(f"{w.filename}:{w.lineno}: {w.category.__name__}: {w.message}" for w in caught)
    return Finished(files, time.perf_counter() - begun, warned)


def _session(run: "StudyRun", number: int) -> dict[str, bytes]:
    from harness.session.borrowed import make_all_parts  # noqa: PLC0415  # the runner needs none
    from harness.session.session import Session  # noqa: PLC0415  # the same
    from harness.session.study_run import of_one  # noqa: PLC0415  # the same
    from protocols.record.session import encode  # noqa: PLC0415  # the same

    parts = make_all_parts(run, number, world_of(run))  # a pilot drives the study's own course
    return encode(Session(run, number, world_of(of_one(run, number)), parts).run(), run.digest)


def _part_fault(run: "StudyRun", _number: int) -> InputError | None:
    return _fault(run, _make_parts)


def _make_parts(run: "StudyRun") -> None:
    from harness.session.parts import make_every_part  # noqa: PLC0415  # the runner needs none

    make_every_part(run)


def _fault(run: "StudyRun", *preparations: Callable[["StudyRun"], object]) -> InputError | None:
    """Return why this process cannot prepare for any session; None when it can."""
    try:
        for prepare in preparations:
            prepare(run)
    except InputError as error:
        return error
    except BaseException as error:  # noqa: BLE001  # other people's parts may fail in any way
        at = traceback.extract_tb(error.__traceback__)[-1]
        reason = f"{type(error).__name__}: {error} ({at.filename}:{at.lineno})"
        return InputError(f"{run.study.protocol.name}: its parts cannot be made: {reason}")
    return None


def world_of(run: "StudyRun", *, shared: bool = True) -> "World":
    """Return this process's world for a study, in PyBullet; with ``shared=False``, a new one."""
    protocol = run.study.protocol
    make = _reused_world if shared else _reused_world.__wrapped__
    return make(run.study.course, protocol.laser, protocol.control_period_s, protocol.start_noise)


@lru_cache(maxsize=1)
def _reused_world(
    course: "Course", laser: "LaserSettings", period: float, start_noise: "StartNoise"
) -> "World":
    """Return this process's world: building one costs more than resetting it."""
    from harness.world.bullet_world import BulletWorld  # noqa: PLC0415  # loads PyBullet

    return BulletWorld(course, laser=laser, period=period, start_noise=start_noise)
