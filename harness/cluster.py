"""Tasks on a Dask cluster, when one machine is not enough: ``pip install 'lad-study[cluster]'``."""

import logging
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeVar

from harness.processes import Died
from protocols.errors import InputError

if TYPE_CHECKING:  # an extra
    from distributed import Client, Future

T = TypeVar("T")

PATIENCE_S = 15
"""How long a scheduler may take to answer, and its first worker to be there, s."""

LOST = "the Dask scheduler was lost; the same command again goes on"

AHEAD = 2
"""Tasks per worker thread that are handed out: the one it is in, and the next."""


class Cluster:
    """The workers of a Dask scheduler.

    Parameters
    ----------
    client
        Connected to the scheduler.
    """

    def __init__(self, client: "Client") -> None:
        self._client = client

    def run(
        self, task: Callable[[int], T], numbers: Iterable[int]
    ) -> Iterator[tuple[int, T | Died]]:
        """Run a task for every number, and yield each with its answer as soon as it is there.

        A number whose worker is lost is given to another one; when several were lost over it, it
        is given up. Workers may come and go.

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
        from distributed import as_completed  # noqa: PLC0415  # an extra

        waiting, running = iter(numbers), as_completed()
        under_way: dict[Future[Any], int] = {}
        while True:
            with self._loss_told():
                room = max(1, AHEAD * self._threads()) - len(under_way)
                for number in islice(waiting, max(0, room)):
                    future = self._client.submit(task, number, pure=False)
                    under_way[future] = number
                    running.add(future)
                if not under_way:
                    return
                future = next(running)
                answer = self._answer(future)
            yield under_way.pop(future), answer

    @contextmanager
    def _loss_told(self) -> Iterator[None]:
        """Say that the scheduler was lost, in whichever call that shows."""
        try:
            yield
        except Exception as error:
            connected = self._client.status == "running"
            if connected and not isinstance(error, OSError | CancelledError):
                raise
            raise ConnectionError(LOST) from error

    def _threads(self) -> int:
        return sum(self._client.nthreads().values())

    def _answer(self, future: "Future[Any]") -> Any:
        if future.cancelled():
            raise ConnectionError(LOST)
        error = future.exception()
        if error is not None:  # of the cluster: a task's own exceptions are part of its answer
            return Died(f"{type(error).__name__}: {error}")
        return future.result()


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
    try:
        client = Client(scheduler, timeout=PATIENCE_S)
    except (OSError, ValueError) as error:
        raise InputError(
            f"--scheduler: no Dask scheduler answers at {scheduler!r} ({type(error).__name__}); "
            "allowed: an address like tcp://host:8786"
        ) from None
    with client:
        _wait_for_a_worker(client, scheduler)
        yield Cluster(client)


def _wait_for_a_worker(client: "Client", scheduler: str) -> None:
    try:
        client.wait_for_workers(1, timeout=PATIENCE_S)
    except TimeoutError:
        raise InputError(
            f"--scheduler: no worker has come to {scheduler!r}; "
            f"start some: dask worker {scheduler} --nthreads 1"
        ) from None
