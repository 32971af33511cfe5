"""Write the report of a study, whole or not at all."""

import shutil
from collections.abc import Callable
from pathlib import Path

from analysis.lap_pages.study_page import STUDY_PAGE, study_page
from analysis.processes import HERE, Processes
from analysis.report.page import build_page
from analysis.report.render import draw, figure_files, render
from analysis.results import StudyResults, analyse
from analysis.statistics import statistics_json
from analysis.tables.csv_file import csv_file
from protocols.files.errors import InputError
from protocols.record.atomic import partial_beside
from protocols.record.folder import REPORT
from protocols.record.reader import open_study


def write_report(study_dir: Path, progress: Callable[[str], None] | None = None) -> Path:
    """Analyse a study directory and write its report.

    ``report/`` gets ``index.html`` (one self-contained page), ``study.html`` (the laps behind its
    lap times), ``figures/`` (SVG and PNG), ``tables/`` (CSV) and ``statistics.json``. It is built
    under another name and renamed; an older report is replaced as a whole.

    Parameters
    ----------
    study_dir
        The study directory.
    progress
        Called with a few words about what is being done.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    InputError
        When the directory is not a study, holds no session, cannot be used or cannot be written.
    """
    return write_results(analyse(open_study(Path(study_dir)), progress), progress)


def write_results(
    results: StudyResults,
    progress: Callable[[str], None] | None = None,
    others: Processes = HERE,
) -> Path:
    """Write the report of a study that is analysed already; see ``write_report``.

    Parameters
    ----------
    results
        As ``analyse`` returns them.
    progress
        Called with a few words about what is being done.
    others
        Processes that draw the figures.

    Raises
    ------
    InputError
        When the report cannot be written.
    """
    tell = progress or (lambda _: None)
    study_dir = results.frames.study.folder
    tell("Drawing figures")
    page = build_page(results)
    waiting = draw(page, others)
    tables = {t.name: csv_file(t.frame) for t in page.tables}
    laps = study_page(results)
    drawings = {name: wait() for name, wait in waiting.items()}
    tell("Writing the report")
    contents: dict[str, bytes] = {
        "index.html": render(page, drawings).encode(),
        "statistics.json": statistics_json(results).encode(),
        **({} if laps is None else {STUDY_PAGE: laps.encode()}),
        **figure_files(drawings, "figures/"),
        **{f"tables/{name}.csv": content for name, content in tables.items()},
    }
    try:
        replace_folder(study_dir / REPORT, contents)
    except OSError as error:
        raise InputError(
            f"{study_dir / REPORT}: the report cannot be written: {error.strerror}"
        ) from None
    return study_dir / REPORT / "index.html"


def replace_folder(target: Path, contents: dict[str, bytes]) -> None:
    """Make a folder with these files, in place of whatever has its name.

    Parameters
    ----------
    target
        The folder; one that is there is replaced as a whole.
    contents
        By path in the folder: a file's bytes.

    Raises
    ------
    OSError
        When it cannot be written; the old folder is still there then.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for name in ("old", "new"):
    ...         replace_folder(Path(folder, "report"), {f"tables/{name}.csv": b"n"})
    ...     left = [path.name for path in Path(folder, "report").rglob("*.csv")]
    >>> left
    ['new.csv']
    """
    partial = partial_beside(target)
    aside = partial_beside(target.with_name(f"old-{target.name}"))
    for leftover in (partial, aside):
        _remove(leftover)
    try:
        for name, content in contents.items():
            path = partial / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        if target.exists():
            target.rename(aside)
        partial.rename(target)
    except BaseException:
        shutil.rmtree(partial, ignore_errors=True)
        if aside.exists() and not target.exists():
            aside.rename(target)
        raise
    _remove(aside)


def _remove(path: Path) -> None:
    """Remove a folder; of a link to one, the link."""
    if path.is_symlink():
        path.unlink(missing_ok=True)
    else:
        shutil.rmtree(path, ignore_errors=True)
