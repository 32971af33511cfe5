"""`lad-study validate`: whether a file is right, before anything runs."""

from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import progress_line, say

if TYPE_CHECKING:
    from protocols.resolved import ResolvedStudy


def validate(
    file: Annotated[
        str, typer.Argument(metavar="FILE", help="A protocol, course or instrument file.")
    ],
) -> None:
    """Check a protocol, course or questionnaire without running a lap.

    A fault is one line with file, line, field and what is allowed, and exit code 2.

    Example: lad-study validate my-study.yaml
    """
    from protocols.shipped import locate_any

    # What is no file of ours is refused before the planner and its compiler are imported.
    locate_any(file).document()

    from analysis.attainable import out_of_reach
    from protocols.balance import balance_in_words, groups_in_words
    from protocols.course.schema import Course
    from protocols.load import check_file
    from protocols.parts import installed_parts
    from protocols.resolved import ResolvedStudy

    with progress_line() as tell:
        tell(f"Checking {file}")
        checked = check_file(file)
        if isinstance(checked, ResolvedStudy):
            _try_parts(checked)
    if isinstance(checked, ResolvedStudy):
        protocol = checked.protocol
        say(
            f"{file}: a protocol: {protocol.cohort.participants} participants, "
            f"{len(protocol.laps)} laps on {checked.course.name}"
        )
        for sentence in balance_in_words(protocol):
            say(f"Orders: {sentence}.")
        if (groups := groups_in_words(protocol)) is not None:
            say(f"Groups: {groups}.")
        for name, course in checked.group_courses.items():
            say(f"Groups: {name} drives {course.name}.")
        for warning in out_of_reach(protocol):
            say(f"Caution: {warning}")
        for part in checked.beside:
            say(f"{part.place}: '{part.use}' was not tried: validate does not run {part.module}")
        for use, package in installed_parts(protocol, checked.beside).items():
            say(f"{file}: '{use}' of {package} was not tried: validate runs only what ships")
    else:
        kind = "course" if isinstance(checked, Course) else "questionnaire"
        say(f"{file}: a {kind}: {checked.title}")


def _try_parts(study: "ResolvedStudy") -> None:
    """Make every part that ships once, with its options: as a run would before its first lap."""
    from harness.session.parts import make_every_part
    from harness.session.study_run import StudyRun, portable

    make_every_part(portable(StudyRun(study, seed=0)), only_shipped=True)
