"""The seam that runs tasks in other processes, and what comes back from one."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol, TypeVar

T = TypeVar("T")

MAX_DEATHS = 3
"""Processes that may die of one number before it is given up."""


@dataclass(frozen=True, slots=True)
class Died:
    """The process that ran a task ended without an answer.

    A task may return this itself when its process is unfit for any task: the process is then
    ended, and the number is tried in another one.

    Attributes
    ----------
    reason
        What is known about it, as the end of a sentence.
    retried
        Whether the number is tried again.
    unfit
        Whether no task at all could be run in that process.
    """

    reason: str
    retried: bool = False
    unfit: bool = False


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
        Python's warnings during the session.
    """

    files: dict[str, bytes]
    wall_s: float
    warned: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Failed:
    """A session that raised, with the traceback."""

    trace: str


class Workers(Protocol):
    """Run a task for many numbers in other processes."""

    def run(
        self, task: Callable[[int], T], numbers: Iterable[int]
    ) -> Iterator[tuple[int, T | Died]]:
        """Yield each number with its answer as soon as it is there.

        A task may run again when its process died; it is answered once.
        """
