"""`lad-study open`: a study's report in the browser."""

import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import complain, say
from protocols.files.errors import InputError


def open_report(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
) -> int:
    """Open the report of a study in the browser; exit code 1 where there is no browser to be had.

    Example: lad-study open studies/four-lap-seed0
    """
    from protocols.record.folder import REPORT
    from protocols.record.header import read_header

    read_header(study)
    page = (study / REPORT / "index.html").resolve()
    if not page.is_file():
        raise InputError(f"{study}: has no report yet; `lad-study report {study}` writes it")
    say(f"Report: {page}")
    if webbrowser.open(page.as_uri()):
        return 0
    complain("No browser could be started here: open that file in one.")
    return 1
