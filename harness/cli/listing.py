"""`lad-study protocols`, `courses` and `show`: the shipped files, and their contents."""

from typing import Annotated

import typer

from harness.cli.console import say


def protocols() -> None:
    """List the shipped study protocols."""
    from protocols.load import load_protocol, shipped_protocols

    for name in shipped_protocols():
        say(f"{name:<18} {load_protocol(name).title}")


def courses() -> None:
    """List the shipped courses."""
    from protocols.load import load_course, shipped_courses

    for name in shipped_courses():
        say(f"{name:<18} {load_course(name).title}")


def show(
    name: Annotated[str, typer.Argument(help="A shipped protocol, course or questionnaire.")],
) -> None:
    """Print a shipped file as plain YAML, to be copied and changed.

    Example: lad-study show four-lap > my-study.yaml
    """
    from protocols.shipped import shipped_text

    typer.echo(shipped_text(name), nl=False)
