"""Write the page of a reproduction, whole or not at all."""

import json
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

from analysis.report.blocks import Page, Section
from analysis.report.render import draw, figure_files, render
from analysis.reproduction.accuracy_rows import accuracy_rows
from analysis.reproduction.driver_rows import driver_rows
from analysis.reproduction.evidence import Evidence, gather
from analysis.reproduction.markdown import markdown
from analysis.reproduction.page import build_page
from analysis.reproduction.people_rows import people_rows
from analysis.reproduction.row import Row
from analysis.tables.csv_file import csv_file
from protocols.files.errors import InputError
from protocols.record.atomic import partial_beside

PAGE = "reproduction"
"""Name of the page's files, without their endings."""

Further = Callable[[Path], tuple[Sequence[Section], Sequence[Row]]]
"""From a reproduction's folder to further sections and rows."""


def write_reproduction(
    folder: Path,
    jobs: int = 1,
    tell: Callable[[str], None] | None = None,
    further: Further | None = None,
) -> tuple[Path, tuple[Row, ...]]:
    """Analyse a reproduction's studies, and write its page beside them.

    The folder gets ``reproduction.html`` (self-contained), ``.md`` and ``.json`` (the rows), and
    ``figures/`` (SVG and PNG) and ``tables/`` (CSV), all at once; older ones are replaced.

    Parameters
    ----------
    folder
        The reproduction's.
    jobs
        Processes that teach models, 1 or more.
    tell
        Called with a few words about what is being done.
    further
        Returns the sections and rows that follow the paper's own experiments.

    Returns
    -------
    Path
        The page.
    tuple of Row
        Its rows.

    Raises
    ------
    InputError
        When a study is missing or cannot be used, or the page cannot be written.
    """
    say = tell or (lambda _: None)
    say("Teaching models in random orders")
    evidence = gather(folder, jobs, lambda k, of: say(f"Teaching models in random orders {k}/{of}"))
    say("Drawing figures")
    sections, more = further(folder) if further else ((), ())
    rows = (*rows_of(evidence), *more)
    contents = contents_of(build_page(evidence, rows, sections), rows)
    say("Writing the page")
    try:
        replace_all(folder, contents)
    except OSError as error:
        raise InputError(f"{folder}: the page cannot be written: {error.strerror}") from None
    return folder / f"{PAGE}.html", rows


def rows_of(evidence: Evidence) -> tuple[Row, ...]:
    """Return the rows of the paper's own experiments."""
    return (
        *driver_rows(evidence.lap_times),
        *accuracy_rows(evidence.accuracy, evidence.runs),
        *people_rows(evidence.people),
    )


def contents_of(page: Page, rows: Sequence[Row]) -> dict[str, bytes]:
    """Return every file of a page by name."""
    drawings = {name: wait() for name, wait in draw(page).items()}
    listed = json.dumps([row.as_json() for row in rows], indent=1, allow_nan=False)
    return {
        f"{PAGE}.html": render(page, drawings).encode(),
        f"{PAGE}.md": markdown(page, rows).encode(),
        f"{PAGE}.json": f"{listed}\n".encode(),
        **figure_files(drawings, "figures/"),
        **{f"tables/{t.name}.csv": csv_file(t.frame) for t in page.tables},
    }


def replace_all(folder: Path, contents: dict[str, bytes]) -> None:
    """Put files, and the folders they are in, in the place of those with their names.

    Everything is written under another name first: when that fails, nothing has changed.

    Raises
    ------
    OSError
        When something cannot be written.
    """
    staged = partial_beside(folder / PAGE)
    aside = partial_beside(folder / f"old-{PAGE}")
    try:
        for name, content in contents.items():
            path = staged / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        aside.mkdir()
        for new in sorted(staged.iterdir()):
            _swap(new, folder / new.name, aside / new.name)
    finally:
        shutil.rmtree(staged, ignore_errors=True)
        shutil.rmtree(aside, ignore_errors=True)


def _swap(new: Path, place: Path, aside: Path) -> None:
    """Move a file or folder to its place; an older folder there is moved away first."""
    if place.is_dir():
        place.rename(aside)
    try:
        new.replace(place)
    except OSError:
        if aside.exists():
            aside.rename(place)
        raise
