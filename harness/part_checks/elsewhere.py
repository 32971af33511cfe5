"""Whether the part is the same one in another process, as when sessions run in workers.

A worker is sent the study: the part's name, its options and the course. It makes the part itself,
and sends back what was recorded. So the name must lead to the factory there, and the options must
be picklable; the part need not be.
"""

import pickle
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from harness.part_checks.evidence import saved_if_possible
from harness.part_checks.fault import described
from harness.part_checks.play import first_difference, play
from harness.part_checks.result import CheckResult
from harness.part_checks.role import ROLES, RoleName
from harness.part_checks.setting import Setting
from harness.part_checks.shown import Laps
from harness.part_checks.source import PartSource
from harness.running.open_workers import open_workers
from harness.running.workers import Died

NAME = "another process"
ALLOWED = "made there by its name and options, it answers the same, to the bit"


@dataclass(frozen=True, slots=True)
class There:
    """What another process found.

    Attributes
    ----------
    answers
        Per lap, in a form to be compared.
    saved
        The part's bytes at the end; None for a part that is not saved.
    fault
        Why there are no more answers; None when all are there.
    """

    answers: list[list[Any]] = field(default_factory=list)
    saved: bytes | None = None
    fault: str | None = None


def same_elsewhere(
    role: RoleName, source: PartSource, setting: Setting, laps: Laps, here: There
) -> CheckResult:
    """Make the part in another process, show it the same, and compare."""
    if source.path is None:
        why = f"{source.label} is no function at the top level of a module"
        return CheckResult(NAME, "not checked", why, ALLOWED)
    task = partial(answers_there, role, source.path, source.options, setting, laps)
    return compared(task, here)


def compared(task: "partial[There]", here: There) -> CheckResult:
    """Run a task in another process, and compare what it finds with what was found here."""
    try:
        pickle.dumps(task)
    except Exception as error:  # noqa: BLE001  # other people's objects may refuse in any way
        fault = f"its options cannot be sent there: {described(error)}"
        return CheckResult(NAME, "failed", fault, ALLOWED)
    with open_workers(1) as workers:
        for _, there in workers.run(task, [0]):
            if not (isinstance(there, Died) and there.retried):
                break
    found = f"{sum(map(len, here.answers))} answers are the same there"
    return CheckResult.of(NAME, _fault(here, there), found, ALLOWED)


def answers_there(
    role_name: RoleName,
    path: str,
    options: Mapping[str, Any],
    setting: Setting,
    laps: Laps,
    _number: int,
) -> There:
    """Make the part in this process, which is the other one, and show it the laps."""
    role = ROLES[role_name]
    try:
        part = PartSource(path, role.name, role.shipped, options).make(role, setting)
        played = play(role, part, laps, setting.seed)
        fault = None if played.fault is None else str(played.fault)
        return There(played.plain(), saved_if_possible(part), fault)
    except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code may fail in any way
        return There(fault=f"it cannot be made: {described(error)}")


def _fault(here: There, there: There | Died) -> str | None:
    if isinstance(there, Died):
        return there.reason
    if there.fault is not None:
        return there.fault
    where = first_difference(here.answers, there.answers)
    if where is not None:
        return f"it answers differently there, first in {where}"
    if here.saved is not None and here.saved != there.saved:
        return "it is saved as other bytes there"
    return None
