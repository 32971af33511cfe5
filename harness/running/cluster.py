"""Tasks on a Dask cluster, when one machine is not enough: ``pip install 'lad-study[cluster]'``."""

import gc
import logging
import pickle
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from dataclasses import replace
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


_UNFIT = "lad-study cannot run a session here"
"""The beginning of such an error; machine, Dask's name for the worker and a reason follow."""


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
        self._last_unfit = ""

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
        there, done = _on_worker(pickle.dumps(task)), Queue["Future[Any]"]()
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
                    "is kept)%s",
                    self._scheduler,
                    f"; the last one left, {self._last_unfit}" if self._last_unfit else "",
                )
            said = alone

    def _answer(self, future: "Future[Any]") -> Any:
        from distributed import KilledWorker  # noqa: PLC0415  # an extra

        if future.cancelled():
            raise ConnectionError(LOST)
        error = future.exception()
        if error is None:
            return _placed(*future.result())
        if error.args[:1] == (_UNFIT,):
            _, host, address, reason = error.args
            self._client.retire_workers([address])
            self._last_unfit = f"on {host}: {reason}"
            return Died(self._last_unfit, retried=True, unfit=True)
        # A killed worker's number has been tried on several ones by Dask itself.
        return Died(_in_one_line(error), retried=not isinstance(error, KilledWorker))


def _on_worker(task: bytes) -> Callable[[int], tuple[str, Any]]:
    """Return the function that answers for a number with a machine's name and the task's answer.

    It travels as code, because it is defined in here, and names nothing of ours: a worker on a
    machine without this package can still report what it lacks, instead of ending.
    """

    def run_there(number: int) -> tuple[str, Any]:
        import pickle  # noqa: PLC0415  # it travels without its module
        import socket  # noqa: PLC0415  # the same

        from distributed import get_worker  # noqa: PLC0415  # an extra

        host, address = socket.gethostname(), get_worker().address

        def unfit(reason: str) -> Exception:
            # An error, because a result would be moved to another worker before this one may leave.
            return RuntimeError(_UNFIT, host, address, reason)

        try:
            run = pickle.loads(task)  # noqa: S301  # our own
        except BaseException as error:  # noqa: BLE001  # it is reported, by a name the runner knows
            reason = " ".join(f"{type(error).__name__}: {error}".split())
            raise unfit(reason) from None
        answer = run(number)
        if type(answer).__name__ == "Died":
            raise unfit(answer.reason)
        return host, answer

    return run_there


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
