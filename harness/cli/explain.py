"""`lad-study explain`: what a learnt policy says about helping."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import say


def explain(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
    participant: Annotated[str, typer.Option(help="Participant, e.g. P0001.")],
    out: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Where to.  [default: DIR/explanations]")
    ] = None,
) -> None:
    """Say which inputs a participant's model depends on, where it is unsure, what it leans on.

    Writes a page and a figure from the recorded laps after the first demonstration; nothing is
    simulated, and PyBullet is not needed.

    Example: lad-study explain studies/four-lap-seed0 --participant P0001
    """
    from analysis.explain.write import write_explanation

    say(f"Explanation: {write_explanation(study, participant, out or study / 'explanations')}")
