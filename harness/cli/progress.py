"""How far a run is: sessions, rate and time left."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import timedelta

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from harness.cli.console import ERR, complain

LINES = 20
"""How often progress is printed over a whole run where there is no terminal for a bar."""


@contextmanager
def counted_sessions(label: str = "Sessions") -> Iterator[Callable[[int, int], None]]:
    """Show how many sessions have ended; yield the function to tell it and how many are planned.

    Nothing is shown before the first call, so that an input fault stays one line.
    """
    columns = (TextColumn(label), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    pace_column = TextColumn("{task.fields[pace]}")
    drawn = ERR.is_terminal
    progress = Progress(*columns, pace_column, console=ERR, disable=not drawn)
    before = 0

    def tell(ended: int, planned: int) -> None:
        nonlocal before
        if not progress.tasks:
            before = ended
            progress.add_task(label, total=planned, completed=ended, pace="")
            progress.start()
        task = progress.tasks[0]
        pace = pace_of(ended - before, planned - ended, task.elapsed or 0.0)
        progress.update(task.id, completed=ended, pace=pace)
        if not drawn and (ended == planned or ended % max(1, planned // LINES) == 0):
            complain(f"{label} {ended}/{planned}  {pace}".rstrip())

    try:
        yield tell
    finally:
        progress.stop()


def pace_of(done: int, left: int, elapsed_s: float) -> str:
    """Return in words how fast sessions end, and when the last one will.

    Parameters
    ----------
    done, left
        Sessions this run has ended, and has still to run.
    elapsed_s
        Time since it began, s.

    Examples
    --------
    >>> pace_of(30, 45, 60.0)
    '30.0 a minute, 0:01:30 left'
    """
    if not done or elapsed_s <= 0:
        return ""
    rate = f"{60 * done / elapsed_s:.1f} a minute"
    if not left:
        return rate
    return f"{rate}, {timedelta(seconds=round(elapsed_s * left / done))} left"
