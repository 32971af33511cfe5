"""Show a part what was recorded, and keep what it answers: there is no world."""

import time
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any

from harness.part_checks.fault import Fault, described
from harness.part_checks.plain import differing_fields, plain
from harness.part_checks.role import Role
from harness.part_checks.setting import PARTICIPANT
from harness.part_checks.shown import Laps, Shown
from harness.session.seeds import generator
from participants.driver import WithdrewError

BUDGET_S = 10.0
"""A lap that takes longer than this to answer is cut: the part is too slow, and the check fails."""


@dataclass(slots=True)
class Played:
    """What a part did with what it was shown.

    Attributes
    ----------
    answers
        Per lap, its answers; a withdrawal is the last one, as text.
    seconds
        Per lap, how long each answer took, s.
    changed
        What it wrote into of what it was shown; None when it left everything as it was.
    fault
        What it raised; None when it raised nothing.
    """

    answers: list[list[Any]] = field(default_factory=list)
    seconds: list[list[float]] = field(default_factory=list)
    changed: str | None = None
    fault: Fault | None = None

    def plain(self) -> list[list[Any]]:
        """Return the answers in a form to be compared."""
        return [[plain(answer) for answer in answers] for answers in self.answers]

    def as_far_as_answered(self, laps: Laps) -> Laps:
        """Return the part of a recording that was played."""
        return [lap[: len(answers)] for lap, answers in zip(laps, self.answers, strict=False)]


def play(role: Role, part: Any, laps: Laps, seed: int, first: int = 0) -> Played:
    """Play a recording to a part.

    The part gets copies, which can be written to as in a study: what it writes shows afterwards.
    Arrays that refuse to be written to would fail innocent compiled code.

    Parameters
    ----------
    role
        How the part is asked.
    part
        Newly made, or to be gone on with.
    laps
        What it is shown.
    seed
        Of the random numbers of each lap.
    first
        Position of the first of these laps in the session.
    """
    played = Played()
    for position, shown in enumerate(laps, first):
        copies: list[Shown] = []
        _lap(role, part, position, shown, seed, into=(played, copies))
        _note_changes(played, position, shown, copies)
        if played.fault is not None or _left(played):
            break
    return played


def _lap(
    role: Role,
    part: Any,
    position: int,
    shown: Sequence[Shown],
    seed: int,
    *,
    into: tuple[Played, list[Shown]],
) -> None:
    played, copies = into
    answers: list[Any] = []
    seconds: list[float] = []
    played.answers.append(answers)
    played.seconds.append(seconds)
    where = f"before the first step of lap {position + 1}"
    try:
        role.start(part, position, generator(seed, PARTICIPANT, f"lap {position}/driver"))
        for step, original in enumerate(shown, 1):
            where = f"in step {step} of lap {position + 1}"
            copies.append(deepcopy(original))
            begun = time.perf_counter()
            answers.append(role.ask(part, copies[-1]))
            seconds.append(time.perf_counter() - begun)
            if sum(seconds) > BUDGET_S:
                break
    except WithdrewError as withdrawal:
        answers.append(f"withdrew: {withdrawal}")
    except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code may fail in any way
        played.fault = Fault(position, where, described(error))


def _note_changes(
    played: Played, position: int, shown: Sequence[Shown], copies: Sequence[Shown]
) -> None:
    """Compare after the lap, so that what is written later than in its own step shows, too."""
    for step, (original, copy) in enumerate(zip(shown, copies, strict=False), 1):
        names = differing_fields(original, copy)
        if names and played.changed is None:
            played.changed = f"{', '.join(names)} of step {step} of lap {position + 1}"


def _left(played: Played) -> bool:
    last = played.answers[-1][-1:]
    return bool(last) and isinstance(last[0], str) and last[0].startswith("withdrew: ")


def first_difference(one: Sequence[Sequence[Any]], other: Sequence[Sequence[Any]]) -> str | None:
    """Return where two lists of laps' answers differ first; None when they are equal.

    Examples
    --------
    >>> first_difference([[1, 2]], [[1, 3]])
    'step 2 of lap 1'
    """
    if len(one) != len(other):
        return f"the number of laps ({len(one)} and {len(other)})"
    for lap, (answers, others) in enumerate(zip(one, other, strict=True), 1):
        for step, (a, b) in enumerate(zip(answers, others, strict=False), 1):
            if a != b:
                return f"step {step} of lap {lap}"
        if len(answers) != len(others):
            return f"step {min(len(answers), len(others)) + 1} of lap {lap}"
    return None
