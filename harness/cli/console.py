"""What the commands print, and how work in progress is shown."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.measure import Measurement
from rich.table import Table

OUT = Console(highlight=False, markup=False, soft_wrap=True)
"""Results go to standard output; paths are never wrapped, so that they can be copied."""

ERR = Console(highlight=False, markup=False, soft_wrap=True, stderr=True)
"""Progress and warnings go to standard error, so that results can be piped."""


def print_table(table: Table) -> None:
    """Print a table as wide as it is: a number that is cut is another number."""
    needed = Measurement.get(OUT, OUT.options.update(width=10_000), table).maximum
    wide = Console(highlight=False, markup=False, width=max(needed, OUT.width))
    wide.print(table, crop=False)


def say(message: str) -> None:
    """Print one line of result."""
    OUT.print(message)


def complain(message: str) -> None:
    """Print one line about the run itself."""
    ERR.print(message)


@contextmanager
def progress_line() -> Iterator[Callable[[str], None]]:
    """Show what is being done now on a line that is replaced; yield the function to call."""
    with ERR.status("Starting") as status:
        yield status.update
