"""Export a study, whole or not at all."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from analysis.export.content import content_of
from analysis.export.privacy import check_includes
from analysis.export.registry import Tell, format_named
from protocols.files.errors import InputError
from protocols.record.atomic import partial_beside
from protocols.record.reader import open_study


def export_study(
    study_dir: Path,
    format_name: str,
    out: Path,
    *,
    include: frozenset[str] = frozenset(),
    licence: str | None = None,
    tell: Tell | None = None,
) -> None:
    """Write a study in another format into a new folder.

    The same study gives the same bytes. Steps are read lap by lap.

    Parameters
    ----------
    study_dir
        The study directory; only read.
    format_name
        One of ``registry.format_names()``.
    out
        Folder to make.
    include
        Names in ``privacy.INCLUDES``: what is kept although it could tell who took part.
    licence
        One of ``sharing.LICENCES``, or a text file's path; None for CC0 of simulated people's data.
    tell
        Told what is being done.

    Raises
    ------
    InputError
        When the study, the format, what to include or the licence cannot be used, or ``out`` is
        there already; nothing is left behind then.

    Examples
    --------
    >>> export_study(Path("nowhere"), "frictionless", Path("shared"))
    Traceback (most recent call last):
    protocols.files.errors.InputError: nowhere: no such folder
    """
    check_includes(include)
    write = format_named(format_name)
    content = content_of(open_study(study_dir), licence, include)
    with new_folder(out) as folder:
        write(content, folder, tell or (lambda _: None))


@contextmanager
def new_folder(target: Path) -> Iterator[Path]:
    """Yield a folder to fill, which gets the target's name when all has gone well.

    Parameters
    ----------
    target
        The folder; it must not exist yet, or be empty.

    Raises
    ------
    InputError
        When the target exists or cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as place:
    ...     with new_folder(Path(place, "out")) as folder:
    ...         _ = (folder / "laps.csv").write_text("lap")
    ...     files = sorted(path.name for path in Path(place, "out").iterdir())
    >>> files
    ['laps.csv']
    """
    if target.exists() and not (target.is_dir() and not any(target.iterdir())):
        raise InputError(f"{target}: is there already; allowed: a new folder")
    partial = partial_beside(target)
    try:
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        yield partial
        if target.exists():
            target.rmdir()
        partial.rename(target)
    except OSError as error:
        raise InputError(f"{target}: cannot be written: {error.strerror or error}") from None
    finally:
        shutil.rmtree(partial, ignore_errors=True)
