"""`lad-study watch`: how far a running study is."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import ERR, say
from harness.cli.progress import pace_of

if TYPE_CHECKING:
    from protocols.record.standing import Standing

EVERY_S = 2.0
"""How often the study directory is looked at, s."""


def watch(
    study: Annotated[Path, typer.Argument(metavar="DIR", help="A study directory.")],
    once: Annotated[bool, typer.Option("--once", help="Look once, and end.")] = False,
) -> None:
    """Show how far a running study is: sessions, rate, laps, failures; living people's stages.

    Ends when the run that writes into the directory has ended, or with Ctrl-C; the run does not
    notice. Where there is no terminal, a line is printed whenever something has changed.

    Example: lad-study watch studies/four-lap-seed0
    """
    from protocols.record.standing import standing

    if once or not ERR.is_terminal:
        said = ""
        while True:
            now = standing(study)
            line = in_words(now, rate=once)
            if line != said:
                say(line)
                said = line
            if once or now.since_s is None:
                break
            time.sleep(EVERY_S)
    else:
        with ERR.status("Looking") as status:
            while (now := standing(study)).since_s is not None:
                status.update(in_words(now, rate=True))
                time.sleep(EVERY_S)
        say(in_words(now, rate=True))
    if now.since_s is None:
        say("No run is writing into it.")


def in_words(now: "Standing", *, rate: bool) -> str:
    """Return how far a study is, in one line.

    Examples
    --------
    >>> from protocols.record.standing import Standing
    >>> in_words(Standing(12, 6, 30, 1, ("P0004",), ("P0008: lap 2",), 60.0, 6), rate=True)
    '6 of 12 sessions, 6.0 a minute, 0:00:50 left; 30 laps, 1 unfinished; 1 failed: P0004; P0008: lap 2'
    """  # noqa: E501  # the line as it is printed
    planned = "" if now.planned is None else f" of {now.planned}"
    parts = [f"{now.done}{planned} sessions"]
    if rate and now.since_s is not None:
        left = max((now.planned or now.done) - now.done - len(now.failed), 0)
        pace = pace_of(now.done_since, left, now.since_s)
        parts = [", ".join(filter(None, (*parts, pace)))]
    parts.append(f"{now.laps} laps, {now.unfinished} unfinished")
    if now.failed:
        names = ", ".join(now.failed[:5]) + (", ..." if len(now.failed) > 5 else "")
        parts.append(f"{len(now.failed)} failed: {names}")
    return "; ".join((*parts, *now.under_way))
