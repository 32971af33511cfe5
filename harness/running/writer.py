"""Sessions on their way to the disk: a few are written at once, and each is whole before it counts.

Most of the time that writing a session takes is waiting until the disk has it. Sessions that wait
together wait for the same commits of the file system, so several take little longer than one.
"""

from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Self

from harness.running.workers import Finished
from protocols.record.store import write_session, write_timing, write_warnings

AT_ONCE = 8
"""Sessions that are being written at a time: more of them only take memory."""


class Writer:
    """Writes sessions into a study directory; a context, at whose end none is under way.

    Each session is written, and waited for, just as one alone: see
    ``protocols.record.sessions.write_session``.

    Parameters
    ----------
    out
        The study directory.
    at_once
        Sessions that are being written at a time.
    """

    def __init__(self, out: Path, at_once: int = AT_ONCE) -> None:
        self._out, self._at_once = out, at_once
        self._pool = ThreadPoolExecutor(at_once, "writer")
        self._under_way: deque[tuple[str, Finished, Future[None]]] = deque()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        # Those that have begun are finished; an interrupted run keeps them.
        self._pool.shutdown(wait=True, cancel_futures=True)

    def write(self, participant: str, session: Finished) -> list[str]:
        """Begin to write a session; wait when too many are under way.

        Returns
        -------
        list of str
            Participants whose sessions are on the disk and have not been named before.

        Raises
        ------
        OSError
            When one of them cannot be written; the others that were begun are there, or will be
            at the context's end.
        """
        future = self._pool.submit(write_session, self._out, participant, session.files)
        self._under_way.append((participant, session, future))
        return list(self._written(self._at_once - 1))

    def wait(self) -> list[str]:
        """Wait for all that are under way, and name them. Raises as ``write`` does."""
        return list(self._written(0))

    def _written(self, most: int) -> Iterator[str]:
        """Yield those that are on the disk, waiting until at most so many are not."""
        while self._under_way and (len(self._under_way) > most or self._under_way[0][2].done()):
            participant, session, future = self._under_way.popleft()
            future.result()
            write_timing(self._out, participant, session.wall_s)
            write_warnings(self._out, participant, session.warned)
            yield participant
