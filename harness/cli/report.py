"""`lad-study report`: from a study directory to a page. Never loads PyBullet."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import say
from harness.cli.reporting import warm_up_report, write_report_of


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
    _, page = write_report_of(study, beside, warm=warm_up_report())
    say(f"Report: {page}")
