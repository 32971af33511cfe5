"""`lad-study check`: whether a study directory is whole."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import progress_line, say


def check(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
) -> int:
    """Verify a study: sessions, checksums, schema, codebook, row counts.

    Prints one line for each fault, with what to run; exit code 1 when there is a fault.

    Example: lad-study check studies/four-lap-seed0
    """
    from protocols.record.check import check_remarks, check_study

    with progress_line() as tell:
        faults = check_study(study, tell)
    for fault in faults:
        say(fault)
    if not faults:
        for remark in check_remarks(study):
            say(f"{study}: remark: {remark}")
        say(f"{study}: whole")
    return 1 if faults else 0
