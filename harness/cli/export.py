"""`lad-study export`: a study in a format that other people's tools accept."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import progress_line, say


def export(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
    out: Annotated[Path, typer.Option(metavar="OUT", help="Folder to make.")],
    format_name: Annotated[
        str,
        typer.Option(
            "--format",
            metavar="FORMAT",
            help="frictionless, r, mcap, lerobot, bids, psych-ds, ro-crate, or an installed one.",
        ),
    ] = "frictionless",
    include: Annotated[
        list[str] | None,
        typer.Option(help="Keep what could tell who took part: ages (exact), words (free), ids."),
    ] = None,
    licence: Annotated[
        str | None,
        typer.Option(
            help="Such as CC-BY-4.0, or a text file; living people's data need one.",
            show_default="CC0-1.0 for simulated people",
        ),
    ] = None,
) -> None:
    """Write a study in another format, with README, licence and units.

    Ages are given in bands and free text is left out unless asked for. Living people's data are
    exported only with a licence and a consent that allows sharing.

    Example: lad-study export studies/four-lap-seed0 --format r --out four-lap-r
    """
    from analysis.export.write import export_study

    with progress_line() as tell:
        export_study(
            study, format_name, out, include=frozenset(include or ()), licence=licence, tell=tell
        )
    say(f"Export: {out}")
