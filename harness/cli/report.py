"""`lad-study report`: from a study directory to a page. Never loads PyBullet."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import progress_line, say
from harness.cli.options import cores


def report(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
    beside: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Another study, whose people are shown beside this one's: "
            "synthetic ones beside living ones.",
        ),
    ] = None,
) -> None:
    """Write the report of a study: one self-contained page, figures, tables and statistics.

    Works on a copied study directory, also where PyBullet is not installed. An older report is
    replaced as a whole.

    Example: lad-study report studies/four-lap-seed0
    """
    from analysis.report.write import write_results
    from analysis.results import analyse
    from protocols.record.reader import open_study

    other = None if beside is None else open_study(beside)
    with progress_line() as tell:
        page = write_results(analyse(open_study(study), tell, cores(), other), tell)
    say(f"Report: {page}")
