"""`lad-study recover`: sessions from their journals."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import complain, progress_line, say


def recover(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
) -> int:
    """Rebuild missing and damaged sessions from their journals; nothing is deleted.

    A session that broke off is rebuilt up to the end of its journal. A damaged one is moved to
    DIR/set-aside first. Exit code 1 when a journal cannot be used.

    Example: lad-study recover studies/ward-pilot
    """
    from harness.running.recovery import recover_sessions

    with progress_line():
        outcome = recover_sessions(study)
    for name in outcome.recovered:
        say(f"{name}: rebuilt from its journal")
    for fault in outcome.faults:
        complain(fault)
    if not outcome.recovered and not outcome.faults:
        say(f"{study}: no session to recover; {len(outcome.whole)} with a journal are whole")
    return 1 if outcome.faults else 0
