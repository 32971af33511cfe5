"""`lad-study import`: maps become courses, recordings become studies, exports become answers."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import complain, say
from protocols.files.errors import InputError

app = typer.Typer(
    name="import",
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Bring in a building's map, a wheelchair's recording, or a questionnaire's export.",
)

_GUESS = typer.Option("--guess", help="Print a draft of the mapping, and do nothing else.")


def needed(option: str, value: Path | None) -> Path:
    """Return an option's value, or refuse that it is missing.

    Raises
    ------
    InputError
        Names the option.
    """
    if value is None:
        raise InputError(f"{option}: missing; allowed: a path (or --guess, which needs none)")
    return value


@app.command("answers")
def answers(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A questionnaire export (CSV).")],
    mapping: Annotated[
        Path | None, typer.Option("--map", metavar="MAPPING.yaml", help="What is where in it.")
    ] = None,
    study: Annotated[
        Path | None, typer.Option(metavar="DIR", help="A study that was recorded elsewhere.")
    ] = None,
    guess: Annotated[bool, _GUESS] = False,
) -> None:
    """Add a questionnaire service's answers to a study.

    Everything that belongs to nothing is listed. A commented mapping to copy:
    lad-study show answers-mapping.

    Example: lad-study import answers qualtrics.csv --map answers.yaml --study studies/ward
    """
    if guess:
        from protocols.importing.answers.guess import guess_mapping

        typer.echo(guess_mapping(file), nl=False)
        return
    from protocols.importing.answers.write import import_answers

    done = import_answers(file, needed("--map", mapping), needed("--study", study))
    for line in done.unmatched:
        complain(line)
    say(f"Answers: {done.rows} questions, {done.answered} answered")
