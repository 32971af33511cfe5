"""The same work for many things, in several processes when there is enough of it."""

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from itertools import islice
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")

WAITING = 4
"""Pieces per process that are under way or waiting: memory must not grow with their number."""


def in_order(work: Callable[[T], R], pieces: Sequence[T], jobs: int) -> Iterator[R]:
    """Yield what a function makes of each piece, in the pieces' order.

    Parameters
    ----------
    work
        Has to be importable in another process, and so has what it returns.
    pieces
        What to do it for.
    jobs
        Number of processes; with 1, this one does it all. With more, each imports the main
        script anew, which must then do its work under ``if __name__ == "__main__"``.

    Examples
    --------
    >>> list(in_order(abs, [-1, 2, -3], 1))
    [1, 2, 3]
    """
    if jobs == 1:
        yield from map(work, pieces)
        return
    # Not by fork: this process may have threads, and a fork of them may never end.
    context = multiprocessing.get_context("spawn")
    left = iter(pieces)
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        ahead: list[Future[R]] = [pool.submit(work, p) for p in islice(left, WAITING * jobs)]
        while ahead:
            done = ahead.pop(0).result()
            ahead += [pool.submit(work, p) for p in islice(left, 1)]
            yield done
