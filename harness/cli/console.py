"""What the commands print, and how work in progress is shown."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console

OUT = Console(highlight=False, markup=False, soft_wrap=True)
"""Results go to standard output; paths are never wrapped, so that they can be copied."""

ERR = Console(highlight=False, markup=False, soft_wrap=True, stderr=True)
"""Progress and warnings go to standard error, so that results can be piped."""


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
