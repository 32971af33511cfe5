"""`lad-study init`: a first protocol from five questions."""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, cast, get_args

import typer
from pydantic import TypeAdapter, ValidationError

from harness.cli.console import say
from protocols.files.errors import InputError
from protocols.files.file_model import Name

Check = Callable[[str], str]
"""Returns an answer as it counts; raises ``InputError`` with what is allowed."""


def init(
    name: Annotated[str | None, typer.Option(help="What the study is called.")] = None,
    people: Annotated[
        str | None, typer.Option(help="Who drives: synthetic or living people.")
    ] = None,
    participants: Annotated[str | None, typer.Option(help="How many: 1 to 9999.")] = None,
    assistance: Annotated[
        str | None,
        typer.Option(help="Whose help: own-model, borrowed-model (synthetic) or demonstrator."),
    ] = None,
    questionnaire: Annotated[
        str | None, typer.Option(help="Asked after each lap: none, or a shipped one's name.")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="File to write.  [default: NAME.yaml]")] = None,
) -> None:
    """Ask five questions, and write a protocol with comments that can be run at once.

    What an option answers is not asked. A file that is there is never overwritten.

    Example: lad-study init --name ward-pilot --people synthetic --participants 12
    --assistance own-model --questionnaire none
    """
    from protocols.draft import Answers, Help, People, draft
    from protocols.load import check_file, shipped_instruments

    called = answer("--name", "What is the study called?", name, _name, "my-study")
    file = out or Path(f"{called.replace(' ', '-')}.yaml")
    if file.exists():
        raise InputError(f"{file}: is there already; allowed: a new file, with --out")
    who = _choice("--people", "Who drives?", people, get_args(People))
    answers = Answers(
        name=called,
        people=cast("People", who),
        participants=int(
            answer("--participants", "How many take part?", participants, _number, "12")
        ),
        help=cast(
            "Help",
            _choice(
                "--assistance",
                "Whose help is studied?",
                assistance,
                # The pilot who teaches a borrowed model is a synthetic person.
                [h for h in get_args(Help) if who == "synthetic" or h != "borrowed-model"],
            ),
        ),
        questionnaire=_choice(
            "--questionnaire",
            "What is asked after each lap?",
            questionnaire,
            ("none", *shipped_instruments()),
        ),
    )
    _write_new(file, draft(answers, file.name))
    check_file(str(file))
    command = "live" if answers.people == "living" else "run"
    say(f"Protocol: {file}")
    say(f"It is valid. Read and change it, then: lad-study {command} {file}")


def answer(option: str, question: str, given: str | None, check: Check, usual: str) -> str:
    """Return an option's value; without one ask a person at the terminal until it is allowed.

    Raises
    ------
    InputError
        When the option's value is not allowed, or there is none and nobody to ask.
    """
    if given is not None:
        try:
            return check(given)
        except InputError as fault:
            raise InputError(f"{option}: {fault}") from None
    if not sys.stdin.isatty():
        raise InputError(f"{option}: is missing, and there is no terminal to ask at")
    while True:
        try:
            return check(typer.prompt(question, default=usual))
        except InputError as fault:
            typer.echo(str(fault))


def _choice(option: str, question: str, given: str | None, allowed: Sequence[str]) -> str:
    def check(text: str) -> str:
        if text in allowed:
            return text
        raise InputError(f"'{text}' is not known; allowed: {', '.join(allowed)}")

    return answer(option, f"{question} ({', '.join(allowed)})", given, check, allowed[0])


def _name(text: str) -> str:
    try:
        return TypeAdapter(Name).validate_python(text)
    except ValidationError:
        raise InputError(
            f"'{text[:80]}' is no name; allowed: up to 80 letters, digits, spaces, _, . and -, "
            "beginning with a letter or digit"
        ) from None


def _number(text: str) -> str:
    if text.isascii() and text.isdigit() and 1 <= int(text) <= 9999:
        return text
    raise InputError(f"'{text[:20]}' is not allowed; allowed: a whole number from 1 to 9999")


def _write_new(file: Path, text: str) -> None:
    """Write a file that is not there yet, whole or not at all."""
    try:
        with file.open("x", encoding="utf-8") as new:
            new.write(text)
    except OSError as error:
        raise InputError(f"{file}: cannot be written: {error.strerror}") from None
