"""Whether a part's answers follow from what it is shown, and from nothing else.

What cannot be seen from outside can be shown by an experiment. A part took its place in a lap:
the world moved on around it. Another one, made alike, is shown a recording of the same, while the
world is at the start. One that looks at what it is shown answers the same. One that reaches
for the world itself, by the frames of its callers or among all objects of the process, finds
another state there, or none, and answers differently or fails.
"""

from typing import Any

from harness.part_checks.evidence import Evidence
from harness.part_checks.plain import plain
from harness.part_checks.play import first_difference
from harness.part_checks.result import CheckResult
from harness.part_checks.role import ASSISTANT, Role

NAME = "sees no more than it is shown"

_SHOWN = {
    "driver": "a Sight in each step",
    "impairment": "a Sight in each step",
    "demonstrator": "a Sight and the 19 inputs in each step",
    "assistant": "the 19 inputs in each step",
}


def sees_no_more(role: Role, part: Any, evidence: Evidence) -> CheckResult:
    """Compare a part in a lap with one that is shown a recording of it."""
    allowed = f"answers follow from {_SHOWN[role.name]}, what came before, and the seed"
    if role is ASSISTANT and callable(getattr(part, "look", None)):
        fault = "it has a method look; a lap shows the room to a demonstrator, and never calls it"
        return CheckResult(NAME, "failed", fault, allowed)
    driven, repeated = evidence.driven, evidence.repeated
    alone = evidence.first.fault or repeated.fault
    if driven.fault is not None:
        return CheckResult(NAME, "not checked", "it did not get through its laps", allowed)
    if alone is not None:
        fault = f"in a lap it works; shown a recording of one, {alone}"
        return CheckResult(NAME, "failed", fault, allowed)
    if evidence.first.plain() != evidence.again.plain():
        why = "it answers differently each time"
        return CheckResult(NAME, "not checked", why, allowed)
    if repeated.changed is not None:
        why = f"it writes into what it is shown ({repeated.changed})"
        return CheckResult(NAME, "not checked", why, allowed)
    given = [[plain(answer) for answer in lap] for lap in driven.answers]
    where = first_difference(given, repeated.plain())
    fault_or_none = (
        None
        if where is None
        else f"in a lap it answers differently than when shown a recording of it, first in {where}"
    )
    found = f"{sum(map(len, given))} answers in laps are those to a recording of them"
    return CheckResult.of(NAME, fault_or_none, found, allowed)
