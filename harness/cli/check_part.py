"""`lad-study check-part`: whether a part does what a study will ask of it."""

import os
import sys
from typing import TYPE_CHECKING, Annotated, Any

import typer

from harness.cli.console import progress_line, say

if TYPE_CHECKING:
    from harness.part_checks import PartReport, Setting


def check_part(
    part: Annotated[
        str, typer.Argument(metavar="PART", help="module:factory, or a shipped part's name.")
    ],
    role: Annotated[
        str | None,
        typer.Option(
            metavar="ROLE",
            help="driver, assistant, demonstrator, respondent, impairment or world.",
            show_default="what PART makes",
        ),
    ] = None,
    option: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE", help="As a protocol gives it; a VALUE is JSON, or else text."
        ),
    ] = None,
    course: Annotated[str, typer.Option(help="A name or a file.")] = "lab-office",
    instrument: Annotated[
        str, typer.Option(help="What a respondent is asked: a name or a file.")
    ] = "driving-assistance",
    period: Annotated[float, typer.Option(help="Control period, 0.02 to 0.5 s.")] = 0.1,
    seed: Annotated[int, typer.Option(help="0 or more.")] = 0,
) -> int:
    """Put a driver, assistant or other part of your own through what a study asks of it.

    Prints a line for each check: what was found, what is allowed. Exit code 1 when one fails.

    Example: lad-study check-part gentle:gentle --option share=0.8
    """
    # Last: a module here cannot hide an installed one. Other commands run nothing from here.
    sys.path.append(os.path.realpath(os.curdir))
    options = dict(_read(given) for given in option or [])
    with progress_line() as tell:
        tell(f"Checking {part}")
        report = _report(part, role, options, _setting(course, instrument, period, seed))
    say(f"{report.part}, checked as {_a(report.role)}")
    for result in report.results:
        say(str(result))
    say(_summary(report))
    return 0 if report.passed else 1


def _setting(course: str, instrument: str, period: float, seed: int) -> "Setting":
    from harness.cli.options import check_least
    from harness.part_checks import Setting
    from protocols.files.errors import InputError
    from protocols.load import load_course, load_instrument

    check_least("--seed", seed, 0)
    if not 0.02 <= period <= 0.5:
        raise InputError(f"--period: {period:g} is out of range; allowed: 0.02 to 0.5")
    return Setting(load_course(course), load_instrument(instrument), period, seed)


def _report(
    part: str, role: str | None, options: dict[str, Any], setting: "Setting"
) -> "PartReport":
    from harness.part_checks import CHECKS
    from harness.part_checks.guess import guess_role
    from protocols.files.errors import InputError
    from protocols.files.suggestion import allowed

    if role is not None and role not in CHECKS:
        raise InputError(f"--role: no role is called {role!r}; {allowed(role, CHECKS)}")
    return CHECKS[role or guess_role(part, options, setting)](part, options, setting)


def _read(given: str) -> tuple[str, Any]:
    """Return the name and the value of an option.

    Examples
    --------
    >>> _read("share=0.8"), _read("file=log.csv")
    (('share', 0.8), ('file', 'log.csv'))
    """
    import json

    from protocols.files.errors import InputError

    name, equals, value = given.partition("=")
    if not (name and equals):
        raise InputError(f"--option: {given!r} is not understood; allowed: NAME=VALUE")
    try:
        return name, json.loads(value)
    except ValueError:
        return name, value


def _a(role: str) -> str:
    return f"an {role}" if role[0] in "ai" else f"a {role}"


def _summary(report: "PartReport") -> str:
    number = len(report.results)
    if report.failed:
        return f"{len(report.failed)} of {number} checks failed: {', '.join(report.failed)}"
    passed = sum(result.state == "passed" for result in report.results)
    return f"{passed} of {number} checks passed, none failed"
