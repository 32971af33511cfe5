"""Tasks on a Dask cluster, when one machine is not enough: ``pip install 'lad-study[cluster]'``."""

import gc
import logging
import pickle
import socket
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from queue import Empty, Queue
from typing import TYPE_CHECKING, Any, TypeVar

from harness.running.workers import MAX_DEATHS, Died, Failed
from protocols.files.errors import InputError

if TYPE_CHECKING:  # an extra
    from distributed import Client, Future

T = TypeVar("T")

PATIENCE_S = 15
"""How long a scheduler may take to answer, and its first worker to be there, s."""

LOOK_S = 5
"""How often to check that there is still a worker while none answers, s."""

LOST = "the Dask scheduler was lost; the same command resumes the run"

AHEAD = 2
"""Tasks per worker thread that are handed out: the one it is in, and the next."""

_LOG = logging.getLogger(__name__)
"""Urgent messages; without further settings they go to standard error."""


class UnfitError(Exception):
    """No task can be run in this worker.

    Parameters
    ----------
    host, address
        The worker's machine, and Dask's name for the worker.
    reason
        As a sentence's end.
    """

    def __init__(self, host: str, address: str, reason: str) -> None:
        super().__init__(host, address, reason)  # all of them: it is pickled
        self.host, self.address, self.reason = host, address, reason


class Cluster:
    """The workers of a Dask scheduler.

    Parameters
    ----------
    client
        Connected to the scheduler.
    scheduler
        Its address, as it was given.
    """

    def __init__(self, client: "Client", scheduler: str) -> None:
        self._client, self._scheduler = client, scheduler

    def run(
        self, task: Callable[[int], T], numbers: Iterable[int]
    ) -> Iterator[tuple[int, T | Died]]:
        """Run a task for every number, and yield each with its answer as soon as it is there.

        A number whose worker is lost is given to another one; when several were lost over it, it
        is given up. A worker that answers ``Died`` leaves the cluster, and its number is tried
        elsewhere. Workers may come and go; while there is none, that is logged, and waited for.

        Parameters
        ----------
        task
            Has to be importable on the workers.
        numbers
            Never more than a few of them are on the cluster, so that answers do not pile up.

        Raises
        ------
        ConnectionError
            When the scheduler is lost.
        """
        waiting, deaths = deque(numbers), Counter[int]()
        there, done = partial(_on_worker, pickle.dumps(task)), Queue["Future[Any]"]()
        under_way: dict[Future[Any], int] = {}
        while waiting or under_way:
            with self._loss_told():
                room = max(1, AHEAD * self._threads()) - len(under_way)
                for _ in range(min(room, len(waiting))):
                    number = waiting.popleft()
                    future = self._client.submit(there, number, pure=False)
                    under_way[future] = number
                    future.add_done_callback(done.put)
                future = self._next(done)
                answer = self._answer(future)
            number = under_way.pop(future)
            if isinstance(answer, Died) and answer.retried:
                deaths[number] += 1
                answer = replace(answer, retried=deaths[number] < MAX_DEATHS)
                if answer.retried:
                    waiting.append(number)
            yield number, answer

    @contextmanager
    def _loss_told(self) -> Iterator[None]:
        """Raise that the scheduler was lost, in every call that can notice it."""
        try:
            yield
        except Exception as error:
            connected = self._client.status == "running"
            if connected and not isinstance(error, OSError | CancelledError):
                raise
            raise ConnectionError(LOST) from error

    def _threads(self) -> int:
        return sum(self._client.nthreads().values())

    def _next(self, done: "Queue[Future[Any]]") -> "Future[Any]":
        """Wait for a task's end; log once that no worker is left."""
        said = False
        while True:
            try:
                return done.get(timeout=LOOK_S)
            except Empty:
                alone = not self._threads()
            if alone and not said:
                _LOG.warning(
                    "no worker is left at %s: waiting for one (Ctrl-C stops; what was finished "
                    "is kept)",
                    self._scheduler,
                )
            said = alone

    def _answer(self, future: "Future[Any]") -> Any:
        from distributed import KilledWorker  # noqa: PLC0415  # an extra

        if future.cancelled():
            raise ConnectionError(LOST)
        error = future.exception()
        if error is None:
            return _placed(*future.result())
        if isinstance(error, UnfitError):
            self._client.retire_workers([error.address])
            return Died(f"on {error.host}: {error.reason}", retried=True)
        # A killed worker's number has been tried on several ones by Dask itself.
        return Died(_in_one_line(error), retried=not isinstance(error, KilledWorker))


def _on_worker(task: bytes, number: int) -> tuple[str, Any]:
    """Return this machine's name and a task's answer.

    Raises
    ------
    UnfitError
        When the task cannot even be loaded, or says that none can be run here. As an exception,
        because a result would have to be moved to another worker before this one may leave.
    """
    from distributed import get_worker  # noqa: PLC0415  # an extra

    host, address = socket.gethostname(), get_worker().address
    try:
        run = pickle.loads(task)  # noqa: S301  # our own
    except BaseException as error:
        raise UnfitError(host, address, _in_one_line(error)) from error
    answer = run(number)
    if isinstance(answer, Died):
        raise UnfitError(host, address, answer.reason)
    return host, answer


def _in_one_line(error: BaseException) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())


def _placed(host: str, answer: Any) -> Any:
    """Return an answer that names the machine when it failed."""
    if isinstance(answer, Failed):
        return replace(answer, trace=f"On {host}:\n{answer.trace}")
    if isinstance(answer, InputError):
        return InputError(*(f"{fault} (on {host})" for fault in answer.faults))
    return answer


@contextmanager
def cluster(scheduler: str) -> Iterator[Cluster]:
    """Connect to a scheduler for as long as the context lasts.

    Raises
    ------
    InputError
        When Dask is not installed, no scheduler answers at the address, or it has no worker.
    """
    try:
        from distributed import Client  # noqa: PLC0415  # an extra
    except ImportError:
        raise InputError(
            "--scheduler: needs Dask; install it with pip install 'lad-study[cluster]'"
        ) from None
    for name in ("distributed", "distributed.client", "tornado.application"):
        logging.getLogger(name).setLevel(logging.CRITICAL)  # what matters is raised
    client, reason = None, ""
    try:
        client = Client(scheduler, timeout=PATIENCE_S)
    except (OSError, ValueError, TypeError) as error:  # the last one by tls:// without keys
        reason = type(error).__name__
    if client is None:
        # The client that could not connect closes when it is collected, and waits for ever if that
        # happens while the next one is being made: Dask's lock is not reentrant.
        gc.collect()
        raise InputError(
            f"--scheduler: no Dask scheduler answers at {scheduler!r} ({reason}); "
            "allowed: an address like tcp://host:8786"
        )
    with client:
        _wait_for_a_worker(client, scheduler)
        yield Cluster(client, scheduler)


def _wait_for_a_worker(client: "Client", scheduler: str) -> None:
    try:
        client.wait_for_workers(1, timeout=PATIENCE_S)
    except TimeoutError:
        raise InputError(
            f"--scheduler: no worker has come to {scheduler!r}; "
            f"start some: dask worker {scheduler} --nthreads 1"
        ) from None
