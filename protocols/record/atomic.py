"""Files that appear whole or not at all, even when the process is killed."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PARTIAL = ".partial-"
"""How names of unfinished files and folders begin; no reader opens them."""


def write_whole(path: Path, content: bytes) -> None:
    """Write a file so that, at every moment, it has its old content or its new one.

    Raises
    ------
    OSError
        When it cannot be written; the old content is still there.
    """
    partial = partial_beside(path)
    try:
        write_through(partial, content)
        partial.replace(path)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise
    sync_folder(path.parent)


def partial_beside(path: Path) -> Path:
    """Return where to build a file or folder before it gets its name."""
    return path.with_name(f"{PARTIAL}{path.name}-{os.getpid()}")


def write_through(path: Path, content: bytes) -> None:
    """Write a file and wait until it is on the disk."""
    with naming(path), path.open("wb") as opened:
        opened.write(content)
        opened.flush()
        os.fsync(opened.fileno())


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Add the file's name to errors of the system, also to those while it is being written."""
    try:
        yield
    except OSError as error:
        error.filename = error.filename or str(path)
        raise


def sync_folder(folder: Path) -> None:
    """Wait until a folder's list of names is on the disk, where the system can confirm it."""
    if os.name != "posix":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def is_partial(path: Path) -> bool:
    """Return whether a file or folder is unfinished."""
    return path.name.startswith(PARTIAL)


def remove_partials(folder: Path) -> None:
    """Remove what a killed process left unfinished in a folder."""
    for path in folder.glob(f"{PARTIAL}*"):
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)
