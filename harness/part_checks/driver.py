"""Check a driver, and what it shares with a driver who has an impairment: it drives every lap."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from harness.part_checks.commands import driver_commands
from harness.part_checks.evidence import Evidence
from harness.part_checks.lap_part import RESET, Part, check_lap_part, raised_later
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.role import DRIVER
from harness.part_checks.setting import Setting
from harness.part_checks.shown import Moment
from harness.part_checks.source import PartSource
from protocols.course.centreline import Centreline

HALF = 0.5
"""A second lap that begins like the first one must get at least this share of the first one's way
in the same time. People learn and vary, so the laps need not be equal; a driver that was not
reset gets nowhere."""

LEAST_WAY = 0.5
"""A first lap shorter than this, m, does not show how far a driver gets."""


def check_driver(
    part: Part, options: Mapping[str, Any] | None = None, setting: Setting | None = None
) -> PartReport:
    """Put a driver through what a study will ask of it.

    Three laps in the Bullet world, the same laps again from a recording, and once more in another
    process; docs/extending.md explains each check.

    Parameters
    ----------
    part
        A shipped name, ``module:factory``, or the factory itself: a function of a ``DriverSetup``.
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
    >>> report = check_driver("autonomous")  # doctest: +SKIP
    >>> assert report.passed, report  # doctest: +SKIP
    """
    chosen = setting or Setting()
    return check_lap_part(DRIVER, part, options, chosen, commands=driver_commands, own=_own)


def _own(_source: PartSource, setting: Setting, evidence: Evidence) -> Iterator[CheckResult]:
    yield drives_again(setting, evidence)


def drives_again(setting: Setting, evidence: Evidence) -> CheckResult:
    """Check that a driver still drives in its second lap, with all that the first one left."""
    allowed = f"a second lap, begun like the first, gets {HALF:.0%} as far in the same time"
    raised = raised_later(evidence, allowed)
    if raised is not None:
        return raised
    laps = evidence.driven.moments
    if len(laps) < 2:
        why = f"it left in lap 1: {evidence.driven.answers[-1][-1:]}"
        return CheckResult(RESET, "not checked", why, allowed)
    steps = min(len(laps[0]), len(laps[1]))
    first, second = (_way(setting, lap[:steps]) for lap in laps[:2])
    found = f"{first:.1f} m along the course in lap 1, {second:.1f} m in lap 2"
    if first < LEAST_WAY:
        return CheckResult(RESET, "not checked", found, allowed)
    return CheckResult.of(RESET, found if second < HALF * first else None, found, allowed)


def _way(setting: Setting, lap: Sequence[Moment]) -> float:
    """Return how far along the course a lap got, m."""
    line = Centreline(setting.course)
    arc, start = 0.0, None
    farthest = 0.0
    for moment in lap:
        arc, _ = line.locate(moment.sight.pose.x, moment.sight.pose.y, arc)
        start = arc if start is None else start
        farthest = max(farthest, arc - start)
    return farthest
