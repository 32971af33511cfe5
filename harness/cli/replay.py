"""`lad-study replay`: a recorded lap as an animated picture."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import progress_line, say


def replay(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
    participant: Annotated[str, typer.Option(help="Participant, e.g. P0001.")],
    lap: Annotated[int, typer.Option(help="Lap, counted from 0.")],
    out: Annotated[Path, typer.Option(help="GIF file to write.")] = Path("lap.gif"),
) -> None:
    """Draw a lap as a GIF from the record: nothing is simulated again.

    Plan view with walls, chair, laser segments and the trail coloured by who has control; p(h)
    below it.

    Example: lad-study replay studies/four-lap-seed0 --participant P0001 --lap 3 --out lap.gif
    """
    from analysis.replay import write_replay

    with progress_line() as tell:
        write_replay(study, participant, lap, out, tell)
    say(f"Replay: {out}")
