"""The same work for many things, and different work at a time, in several processes."""

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from itertools import islice
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
R = TypeVar("R")

WAITING = 4
"""Pieces per process that are under way or waiting: memory must not grow with their number."""


class Processes:
    """Other processes that work for this one; without any, this one does it all.

    Whatever they are asked to do has to be importable in another process, and so have what it is
    given and what it returns.

    Parameters
    ----------
    pool
        Where they are; None for none.
    jobs
        How many there are.
    """

    def __init__(self, pool: Executor | None = None, jobs: int = 1) -> None:
        self._pool, self.jobs = pool, jobs

    def later(self, work: Callable[P, R], *args: P.args, **kwargs: P.kwargs) -> Callable[[], R]:
        """Have some work done, and return the function that waits for what came of it."""
        if self._pool is None:
            return lambda: work(*args, **kwargs)
        return self._pool.submit(work, *args, **kwargs).result

    def in_order(self, work: Callable[[T], R], pieces: Sequence[T]) -> Iterator[R]:
        """Yield what a function makes of each piece, in the pieces' order.

        Examples
        --------
        >>> list(Processes().in_order(abs, [-1, 2, -3]))
        [1, 2, 3]
        """
        if self._pool is None:
            yield from map(work, pieces)
            return
        left = iter(pieces)
        ahead: list[Future[R]] = [
            self._pool.submit(work, piece) for piece in islice(left, WAITING * self.jobs)
        ]
        while ahead:
            done = ahead.pop(0).result()
            ahead += [self._pool.submit(work, piece) for piece in islice(left, 1)]
            yield done


HERE = Processes()
"""No other process."""


@contextmanager
def processes(jobs: int) -> Iterator[Processes]:
    """Return so many processes, for as long as a context lasts.

    Parameters
    ----------
    jobs
        With 1, this process does it all. With more, each imports the main script anew, which must
        then do its work under ``if __name__ == "__main__"``.
    """
    if jobs == 1:
        yield HERE
        return
    # Not by plain fork: this process may have threads, and a fork of them may never end.
    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("forkserver" if "forkserver" in methods else "spawn")
    pool = ProcessPoolExecutor(jobs, mp_context=context)
    try:
        yield Processes(pool, jobs)
    finally:
        pool.shutdown(cancel_futures=True)
