"""Tasks on this machine's cores: one process each; one that dies does not disturb the others.

Every worker has a pipe of its own, so the runner knows what each is doing: when one is killed, its
number is given to another, and the others do not notice. When the runner is killed, its ends of
the pipes close, and each worker ends with the task it is in.
"""

import gc
import multiprocessing
import os
import signal
import tempfile
import threading
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from multiprocessing import forkserver, util
from multiprocessing.connection import Connection, wait
from pathlib import Path
from types import FrameType
from typing import Any, Self, TypeVar, cast

from harness.running.workers import MAX_DEATHS, Died
from protocols.files.errors import InputError

T = TypeVar("T")

# Not plain fork: this process has threads, and a lock that another thread holds would stay locked
# in the child. The fork server has one thread, and the modules are already loaded in it.
_FORKS = "forkserver" in multiprocessing.get_all_start_methods()
_CONTEXT = (
    multiprocessing.get_context("forkserver") if _FORKS else multiprocessing.get_context("spawn")
)
ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "BLIS")}
"""For linear algebra: the cores are taken by other sessions."""

LONGEST_FOLDER = 70
"""Bytes of a temporary folder's path: with the socket's name the system takes 103 and no more."""


def warm_up(modules: Iterable[str]) -> None:
    """Start, in the background, the process that workers are forked from.

    It imports ``modules`` once for all of them, while this process continues; without forking,
    every worker imports them itself.

    Raises
    ------
    InputError
        When the path of every temporary folder is too long for a socket.
    """
    if not _FORKS:
        return
    _make_temporary_folder()
    _CONTEXT.set_forkserver_preload(list(modules))
    # A folder in the working directory must not hide an installed package there.
    # Ctrl-C reaches every process of the terminal, but only the runner may act on it: it keeps what
    # is finished and ends the others. Each would otherwise end with a traceback of its own.
    safe = {**ONE_THREAD, "PYTHONSAFEPATH": "1"}
    with signals_afterwards(), _environment(safe), _deaf_to_interrupts():
        forkserver.ensure_running()


def _make_temporary_folder() -> None:
    """Make the folder of the fork server's socket where its whole path is short enough."""
    folder = temporary_folder()
    if folder is None:
        raise InputError(
            f"TMPDIR: {Path(tempfile.gettempdir())}: a path of at most {LONGEST_FOLDER} bytes "
            "is needed, for the socket between processes"
        )
    kept = tempfile.tempdir
    try:
        tempfile.tempdir = folder
        util.get_temp_dir()  # made once, and then kept
    finally:
        tempfile.tempdir = kept


def temporary_folder() -> str | None:
    """Return a folder for temporary files whose path is short enough for sockets; None for none."""
    for folder in (tempfile.gettempdir(), "/tmp", "/var/tmp"):  # noqa: S108  # a new one inside
        if len(os.fsencode(folder)) <= LONGEST_FOLDER and os.access(folder, os.W_OK):
            return folder
    return None


class Processes:
    """Worker processes; a context that ends them at its exit.

    Parameters
    ----------
    jobs
        How many, 1 or more.

    Raises
    ------
    InputError
        When the path of every temporary folder is too long for a socket.
    """

    def __init__(self, jobs: int) -> None:
        if _FORKS:
            _make_temporary_folder()
        self._jobs = jobs
        self._idle: list[_Worker] = []
        self._busy: dict[Connection, tuple[_Worker, int]] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        workers = [*self._idle, *(worker for worker, _ in self._busy.values())]
        for worker in workers:
            worker.dismiss()
        # First all signals, then all waits: the workers end at the same time.
        for worker in workers:
            worker.process.join()

    def run(
        self, task: Callable[[int], T], numbers: Iterable[int]
    ) -> Iterator[tuple[int, T | Died]]:
        """Run a task for every number, and yield each with its answer as soon as it is there.

        Parameters
        ----------
        task
            Has to be importable in another process; so has its answer.
        numbers
            Each is given to one process, and to another one when that dies.
        """
        waiting, deaths = deque(numbers), Counter[int]()
        while waiting or self._busy:
            self._assign(task, waiting)
            # A pipe is ready when it has an answer, and also when its worker has died.
            for pipe in cast("list[Connection]", wait(list(self._busy))):
                worker, number = self._busy.pop(pipe)
                answer: T | Died = worker.answer()
                if isinstance(answer, Died):
                    # A session that kills its own process would kill every next one, too.
                    deaths[number] += 1
                    answer = Died(answer.reason, retried=deaths[number] < MAX_DEATHS)
                    if answer.retried:
                        waiting.append(number)
                else:
                    self._idle.append(worker)
                # Before the yield: the caller's work on the answer must not keep a core waiting.
                self._assign(task, waiting)
                yield number, answer

    def _assign(self, task: Callable[[int], Any], waiting: deque[int]) -> None:
        while waiting and len(self._busy) < self._jobs:
            worker = self._idle.pop() if self._idle else _Worker()
            number = waiting.popleft()
            self._busy[worker.pipe] = (worker, number)
            with suppress(OSError):  # it is dead; ``answer`` then returns ``Died``
                worker.pipe.send((task, number))


class _Worker:
    """A process, and this end of its pipe."""

    def __init__(self) -> None:
        self.pipe, theirs = _CONTEXT.Pipe()
        self.process = _CONTEXT.Process(target=_serve, args=(theirs,), daemon=True)
        with signals_afterwards(), _environment(ONE_THREAD):
            self.process.start()
        theirs.close()  # else a dead worker's pipe would stay open

    def answer(self) -> Any:
        """Return the worker's answer; ``Died`` when it ended without one."""
        try:
            answer = self.pipe.recv()
        except (EOFError, OSError):
            self._end()
            return Died(_cause(self.process.exitcode))
        if isinstance(answer, Died):
            self._end()
        return answer

    def dismiss(self) -> None:
        """End the worker at once; it holds nothing that could be lost."""
        self.pipe.close()
        self.process.terminate()

    def _end(self) -> None:
        self.dismiss()
        self.process.join()  # only then is there an exit code


def _serve(pipe: Connection) -> None:
    """Answer until the runner has gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # only the runner handles Ctrl-C
    gc.freeze()  # what is imported stays: no collection has to look through it
    with suppress(EOFError, OSError):
        while True:
            task, number = pipe.recv()
            pipe.send(task(number))


def _cause(exit_code: int | None) -> str:
    if exit_code is not None and exit_code < 0:
        return f"its process was killed by {signal.Signals(-exit_code).name}"
    return f"its process ended by itself with exit code {exit_code}"


@contextmanager
def _environment(variables: Mapping[str, str]) -> Iterator[None]:
    """Set environment variables for processes that start now."""
    kept = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in kept.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """Have processes that start now ignore Ctrl-C from their first moment."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    kept = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, kept)


@contextmanager
def signals_afterwards() -> Iterator[None]:
    """Act on Ctrl-C and SIGTERM only when a process has started: half of one prints a traceback."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        came.append(number)

    kept = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    for number, handler in kept.items():
        if callable(handler):
            signal.signal(number, note)
    try:
        yield
    finally:
        for number, handler in kept.items():
            signal.signal(number, handler)
        for missed in came:
            signal.raise_signal(missed)
