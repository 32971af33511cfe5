"""Check an assistant that learns: it gets 19 numbers and what was demonstrated, and is saved."""

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from harness.part_checks.commands import PREDICTED, assistance
from harness.part_checks.evidence import Evidence
from harness.part_checks.fault import described
from harness.part_checks.lap_part import RESET, Part, check_lap_part, raised_later
from harness.part_checks.plain import type_name
from harness.part_checks.play import first_difference, play
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.role import ASSISTANT
from harness.part_checks.setting import Setting
from harness.part_checks.source import PartSource

SAVING = "saving and loading"


def check_assistant(
    part: Part, options: Mapping[str, Any] | None = None, setting: Setting | None = None
) -> PartReport:
    """Put an assistant that learns through what a study will ask of it.

    Parameters
    ----------
    part
        A shipped name, ``module:factory``, or the factory itself: a function of the options, as
        keyword arguments.
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
    >>> report = check_assistant("lad")  # doctest: +SKIP
    >>> assert report.passed, report  # doctest: +SKIP
    """
    chosen = setting or Setting()
    commands = partial(assistance, most=PREDICTED)
    return check_lap_part(ASSISTANT, part, options, chosen, commands=commands, own=_own)


def _own(source: PartSource, setting: Setting, evidence: Evidence) -> Iterator[CheckResult]:
    yield _forgets_the_lap(source, setting, evidence)
    yield _is_saved(source, setting, evidence)


def _taught(source: PartSource, setting: Setting, evidence: Evidence) -> Any:
    """Return a new part that has gone through the demonstration."""
    part = source.make(ASSISTANT, setting)
    play(ASSISTANT, part, evidence.recorded[:1], setting.seed)
    return part


def _forgets_the_lap(source: PartSource, setting: Setting, evidence: Evidence) -> CheckResult:
    """Check that a lap that teaches nothing leaves nothing behind."""
    allowed = "the same lap, shown twice without anything to learn, is answered the same"
    raised = raised_later(evidence, allowed)
    if raised is not None:
        return raised
    if len(evidence.recorded) < 2 or evidence.first.fault is not None:
        return CheckResult(RESET, "not checked", "it did not get through its laps", allowed)
    if evidence.first.plain() != evidence.again.plain():
        return CheckResult(RESET, "not checked", "it answers differently each time", allowed)
    part, lap = _taught(source, setting, evidence), evidence.recorded[1:2]
    once, twice = (play(ASSISTANT, part, lap, setting.seed, first) for first in (1, 2))
    where = first_difference(once.plain(), twice.plain())
    fault = (
        None if where is None else f"shown again, a lap is answered differently, first in {where}"
    )
    return CheckResult.of(RESET, fault, f"{len(lap[0])} answers are the same twice", allowed)


def _is_saved(source: PartSource, setting: Setting, evidence: Evidence) -> CheckResult:
    """Check the bytes that would be kept with a session."""
    allowed = (
        "no to_bytes, or one that returns the same bytes for the same model and changes nothing; "
        "from_bytes, where there is one, returns a model that answers the same"
    )
    if evidence.first.fault is not None or len(evidence.recorded) < 2:
        return CheckResult(SAVING, "not checked", "it did not get through its laps", allowed)
    if evidence.first.plain() != evidence.again.plain():
        return CheckResult(SAVING, "not checked", "it answers differently each time", allowed)
    part = _taught(source, setting, evidence)
    if not callable(getattr(part, "to_bytes", None)):
        found = "it has no to_bytes: a session is kept without the model"
        return CheckResult(SAVING, "passed", found, allowed)
    try:
        fault, found = _saving_fault(part, _taught(source, setting, evidence), setting, evidence)
    except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code may fail in any way
        fault, found = f"it raises {described(error)}", ""
    return CheckResult.of(SAVING, fault, found, allowed)


def _saving_fault(
    part: Any, twin: Any, setting: Setting, evidence: Evidence
) -> tuple[str | None, str]:
    """Return what is wrong with how a part is saved, and what was found besides.

    Parameters
    ----------
    part, twin
        Made and taught alike; the twin is never saved before it has answered.
    """
    data = part.to_bytes()
    if not isinstance(data, bytes):
        return f"to_bytes returns a {type_name(data)}", ""
    if part.to_bytes() != data:
        return "to_bytes returns other bytes when it is called again", ""
    lap = evidence.recorded[1:2]
    found = f"{len(data)} bytes"
    loaded, from_bytes = None, getattr(part, "from_bytes", None)
    if callable(from_bytes):
        loaded = from_bytes(data)
        found += ", a model loaded from them answers the same"
    unsaved = play(ASSISTANT, twin, lap, setting.seed, first=1).plain()
    if play(ASSISTANT, part, lap, setting.seed, first=1).plain() != unsaved:
        return "after to_bytes it answers differently", found
    if loaded is not None:
        again = play(ASSISTANT, loaded, lap, setting.seed, first=1)
        where = again.fault or first_difference(unsaved, again.plain())
        if where is not None:
            return f"loaded by from_bytes it answers differently, first: {where}", found
    if twin.to_bytes() != part.to_bytes():
        return "two models made and taught alike are saved as other bytes", found
    return None, found
