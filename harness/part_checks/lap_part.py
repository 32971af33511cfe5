"""The course of a check for every role that takes part in laps."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from harness.part_checks.common import LAPS, goes_through_laps, in_time, same_answers, unchanged
from harness.part_checks.elsewhere import ALLOWED, There, same_elsewhere
from harness.part_checks.elsewhere import NAME as ELSEWHERE
from harness.part_checks.evidence import Evidence, gather
from harness.part_checks.fault import described
from harness.part_checks.interface import NAME as INTERFACE
from harness.part_checks.interface import interface
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.role import Role
from harness.part_checks.setting import Setting
from harness.part_checks.source import PartSource
from harness.part_checks.truth import sees_no_more
from protocols.files.errors import InputError

Part = str | Callable[..., Any]
"""A part as people name it: a shipped name, ``module:factory``, or the factory itself."""

RESET = "reset between laps"

CommandCheck = Callable[[Mapping[str, Sequence[Any]]], CheckResult]
OwnChecks = Callable[[PartSource, Setting, Evidence], Iterator[CheckResult]]


def made_and_fitting(role: Role, source: PartSource, setting: Setting) -> tuple[Any, CheckResult]:
    """Make the part, and check that it is one of its role.

    Raises
    ------
    InputError
        When the part itself refuses these options.
    """
    try:
        part = source.make(role, setting)
    except InputError:
        raise
    except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code may fail in any way
        allowed = f"{source.label} makes a {role.name}"
        fault = f"its factory raises {described(error)}"
        return None, CheckResult(INTERFACE, "failed", fault, allowed)
    return part, interface(role, part)


def check_lap_part(
    role: Role,
    part: Part,
    options: Mapping[str, Any] | None,
    setting: Setting,
    *,
    commands: CommandCheck,
    own: OwnChecks,
) -> PartReport:
    """Put a part through laps.

    Parameters
    ----------
    role
        Of the part.
    part, options, setting
        What is checked, and where.
    commands
        Checks all its answers.
    own
        The checks of this role alone; the first of them is the one of ``RESET``.

    Raises
    ------
    InputError
        When there is no such part, or it does not take these options.
    """
    source = PartSource(part, role.name, role.shipped, options)
    made, fitting = made_and_fitting(role, source, setting)
    if fitting.state == "failed":
        return PartReport(source.label, role.name, (fitting,))
    evidence = gather(role, source, setting)
    answers = commands(evidence.every_answer)
    results = (
        fitting,
        _laps(role, evidence, answers),
        answers,
        *own(source, setting, evidence),
        same_answers(evidence.first, evidence.again),
        sees_no_more(role, made, evidence),
        unchanged((evidence.first, evidence.repeated), source),
        _elsewhere(role, source, setting, evidence),
        in_time(evidence.first, setting.period),
    )
    return PartReport(source.label, role.name, results)


def _laps(role: Role, evidence: Evidence, answers: CheckResult) -> CheckResult:
    """Report what was raised in the first lap; for later ones the check of ``RESET`` does.

    An error that a wrong answer causes in the lap's own code is not reported twice.
    """
    fault, laps = evidence.driven.fault, evidence.driven.answers
    raised = fault if fault and fault.lap == 0 else None
    result = goes_through_laps(raised, laps, drives=role.name in {"driver", "impairment"})
    if result.state == "failed" and answers.state == "failed" and evidence.first.fault is None:
        why = "a lap cannot go on with such commands"
        return CheckResult(LAPS, "not checked", why, result.allowed)
    return result


def raised_later(evidence: Evidence, allowed: str) -> CheckResult | None:
    """Return the result of ``RESET`` for a part that raised something; None when it did not."""
    fault = evidence.driven.fault
    if fault is None:
        return None
    if fault.lap == 0:
        why = "it did not get through its first lap"
        return CheckResult(RESET, "not checked", why, allowed)
    return CheckResult(RESET, "failed", f"after a lap without an error, {fault}", allowed)


def _elsewhere(role: Role, source: PartSource, setting: Setting, evidence: Evidence) -> CheckResult:
    first = evidence.first
    if first.fault is not None or first.plain() != evidence.again.plain():
        why = "it does not answer the same twice in this process"
        return CheckResult(ELSEWHERE, "not checked", why, ALLOWED)
    here = There(first.plain(), evidence.saved)
    return same_elsewhere(role.name, source, setting, evidence.recorded, here)
