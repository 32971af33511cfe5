"""`lad-study recover`: sessions from their journals."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import complain, progress_line, say

if TYPE_CHECKING:
    from protocols.resolved import ResolvedStudy


def recover(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
    protocol: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The protocol file, for a study with code beside it."),
    ] = None,
    trust: Annotated[
        bool, typer.Option("--trust", help="Allow the code beside the protocol file, as it is now.")
    ] = False,
) -> int:
    """Rebuild missing and damaged sessions from their journals; nothing is deleted.

    A session that broke off is rebuilt up to the end of its journal. A damaged one is moved to
    DIR/set-aside first. Exit code 1 when a journal cannot be used.

    Example: lad-study recover studies/ward-pilot
    """
    from harness.cli.trust import trusted_study
    from harness.running.recovery import recover_sessions
    from protocols.parts import parts_beside

    def with_code(recorded: "ResolvedStudy") -> "ResolvedStudy":
        folder = None if protocol is None else protocol.resolve().parent
        beside = parts_beside(recorded.protocol, folder)
        return trusted_study(replace(recorded, folder=folder, beside=beside), asked=trust)

    with progress_line():
        outcome = recover_sessions(study, with_code)
    for name in outcome.recovered:
        say(f"{name}: rebuilt from its journal")
    for fault in outcome.faults:
        complain(fault)
    if not outcome.recovered and not outcome.faults:
        say(f"{study}: no session to recover; {len(outcome.whole)} with a journal are whole")
    return 1 if outcome.faults else 0
