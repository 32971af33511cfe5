"""`lad-study validate`: whether a file is right, before anything runs."""

from typing import Annotated

import typer

from harness.cli.console import say


def validate(
    file: Annotated[
        str, typer.Argument(metavar="FILE", help="A protocol, course or instrument file.")
    ],
) -> None:
    """Check a protocol, course or questionnaire without running anything.

    A fault is one line with file, line, field and what is allowed, and exit code 2.

    Example: lad-study validate my-study.yaml
    """
    from analysis.attainable import out_of_reach
    from protocols.balance import balance_in_words
    from protocols.course.schema import Course
    from protocols.load import check_file
    from protocols.resolved import ResolvedStudy

    checked = check_file(file)
    if isinstance(checked, ResolvedStudy):
        protocol = checked.protocol
        say(
            f"{file}: a protocol: {protocol.cohort.participants} participants, "
            f"{len(protocol.laps)} laps on {checked.course.name}"
        )
        for sentence in balance_in_words(protocol):
            say(f"Orders: {sentence}.")
        for warning in out_of_reach(protocol):
            say(f"Caution: {warning}")
    else:
        kind = "course" if isinstance(checked, Course) else "questionnaire"
        say(f"{file}: a {kind}: {checked.title}")
