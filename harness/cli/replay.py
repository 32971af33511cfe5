"""`lad-study replay`: recorded laps as a moving picture or a page."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import progress_line, say
from protocols.files.errors import InputError


def replay(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
    participant: Annotated[str | None, typer.Option(help="Participant, e.g. P0001.")] = None,
    lap: Annotated[int | None, typer.Option(help="Lap, counted from 0.")] = None,
    compare: Annotated[
        tuple[str, str] | None,
        typer.Option(metavar="LAP LAP", help="Two laps side by side, e.g. P0001:3 P0001:4."),
    ] = None,
    out: Annotated[Path, typer.Option(help="File to write: .gif, .mp4 or .html.")] = Path(
        "lap.gif"
    ),
) -> None:
    """Draw a lap, or two side by side, from the record: nothing is simulated again.

    A GIF or an MP4 (pip install 'lad-study[video]') shows the plan with chair, laser and trail, and
    p(h). A page (.html) can be moved through: first-person view, plan, sticks, p(h), variance, and
    every value at the cursor; one file that needs no network.

    Example: lad-study replay studies/four-lap-seed0 --participant P0001 --lap 3 --out lap.html
    """
    from analysis.replay import write_replay

    with progress_line() as tell:
        write_replay(study, _wanted(participant, lap, compare), out, tell)
    say(f"Replay: {out}")


def _wanted(
    participant: str | None, lap: int | None, compare: tuple[str, str] | None
) -> list[tuple[str, int]]:
    """Return the laps that the options name.

    Raises
    ------
    InputError
        When they name none, or both one lap and two.
    """
    if compare is not None:
        if participant is not None or lap is not None:
            raise InputError("--compare: names both laps; allowed: without --participant and --lap")
        return [_one(text) for text in compare]
    if participant is None or lap is None:
        missing = "--participant" if participant is None else "--lap"
        raise InputError(f"{missing}: is missing; allowed: --participant and --lap, or --compare")
    return [(participant, lap)]


def _one(text: str) -> tuple[str, int]:
    participant, _, lap = text.rpartition(":")
    if not participant or not (lap.isascii() and lap.isdigit()):
        raise InputError(f"--compare: '{text[:80]}' is no lap; allowed: such as P0001:3")
    return participant, int(lap)
