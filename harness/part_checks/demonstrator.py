"""Check a demonstrator: it sees the room, helps, and does the same as a shadow."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from harness.part_checks.commands import assistance
from harness.part_checks.evidence import Evidence
from harness.part_checks.lap_part import RESET, Part, check_lap_part, raised_later
from harness.part_checks.play import play
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.role import DEMONSTRATOR
from harness.part_checks.setting import Setting
from harness.part_checks.source import PartSource

INTO_HELP = 3
"""A lap is broken off this many steps after help has begun."""


def check_demonstrator(
    part: Part, options: Mapping[str, Any] | None = None, setting: Setting | None = None
) -> PartReport:
    """Put a demonstrator through what a study will ask of it.

    Parameters
    ----------
    part
        A shipped name, ``module:factory``, or the factory itself: a function of a
        ``DemonstratorSetup``.
    options
        What a protocol would give it.
    setting
        Course, control period and seed; the four-lap study's by default.

    Raises
    ------
    InputError
        When there is no such part, or it does not take these options.

    Examples
    --------
    >>> report = check_demonstrator("attentive")  # doctest: +SKIP
    >>> assert report.passed, report  # doctest: +SKIP
    """
    chosen = setting or Setting()
    commands = partial(assistance, most=1.0)
    return check_lap_part(DEMONSTRATOR, part, options, chosen, commands=commands, own=_own)


def _own(source: PartSource, setting: Setting, evidence: Evidence) -> Iterator[CheckResult]:
    yield _lets_go(source, setting, evidence)


def _lets_go(source: PartSource, setting: Setting, evidence: Evidence) -> CheckResult:
    """Check that a lap which was broken off in the middle of help leaves no help behind."""
    allowed = "after a lap broken off while it helped, help begins no earlier than half as late"
    raised = raised_later(evidence, allowed)
    if raised is not None:
        return raised
    lap = evidence.driven.moments[0]
    first = _first_help(evidence.repeated.answers)
    if first is None:
        return CheckResult(RESET, "not checked", "it never helps in lap 1", allowed)
    part = source.make(DEMONSTRATOR, setting)
    play(DEMONSTRATOR, part, [lap[: first + INTO_HELP]], setting.seed)
    second = _first_help(play(DEMONSTRATOR, part, [lap], setting.seed, first=1).answers)
    after = "never" if second is None else f"from step {second}"
    found = f"helps from step {first} when new, {after} after a lap broken off while it helped"
    stale = second is not None and second < first / 2
    return CheckResult.of(RESET, found if stale else None, found, allowed)


def _first_help(answers: Sequence[Sequence[Any]]) -> int | None:
    """Return the step of the first lap in which help begins, counted from 1."""
    lap = answers[0] if answers else ()
    return next((step for step, answer in enumerate(lap, 1) if answer.helping), None)
