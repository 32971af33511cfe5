"""Laps and answers matched with the plan by their own values, not by their place."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import pyarrow as pa

from protocols.files.errors import InputError
from protocols.laps import PlannedLap
from protocols.record.elsewhere.people import one_form


class _Lap(NamedTuple):
    row: int
    participant: str
    number: int
    condition: str


class Practice(NamedTuple):
    """Which laps are practice, and in words how that is known where it is not recorded."""

    column: tuple[bool, ...]
    remarks: tuple[str, ...]


def with_known_conditions(table: pa.Table, known: Iterable[str]) -> tuple[pa.Table, str]:
    """Return a table with conditions as the plan writes them, and a remark where they differed.

    ``Manual`` and ``manual`` are one condition where the plan has only one that reads like it.
    """
    known = set(known)
    given = table["condition"].to_pylist()
    alike: dict[str, list[str]] = defaultdict(list)
    for name in known:
        alike[read_as(name)].append(name)
    meant = {
        name: alike[read_as(name)][0]
        for name in set(given) - known
        if len(alike.get(read_as(name), ())) == 1
    }
    if not meant:
        return table, ""
    place = table.schema.get_field_index("condition")
    mended = pa.array([meant.get(name, name) for name in given], pa.string())
    table = table.set_column(place, table.schema.field(place), mended)
    pairs = ", ".join(f"{name!r} is taken for {meant[name]!r}" for name in sorted(meant))
    return table, f"condition {pairs} ({sum(name in meant for name in given)} rows)"


def read_as(condition: str) -> str:
    """Return what a reader takes a condition's name for: case, blanks and dashes do not tell."""
    return " ".join(one_form(condition).casefold().replace("_", " ").replace("-", " ").split())


def first_number(laps: pa.Table, plan: Sequence[PlannedLap]) -> int | None:
    """Return from which number laps are counted, 0 or 1; None when the laps do not tell.

    The number from which more laps have the condition that is planned at their place.
    """
    pairs = list(zip(laps["lap"].to_pylist(), laps["condition"].to_pylist(), strict=True))
    fits = {first: sum(_planned(plan, n - first) == c for n, c in pairs) for first in (0, 1)}
    if fits[0] == fits[1]:
        return 0 if any(n == 0 for n, _ in pairs) else None
    return max(fits, key=lambda first: fits[first])


def _planned(plan: Sequence[PlannedLap], place: int) -> str | None:
    return plan[place].condition if 0 <= place < len(plan) else None


def practice(laps: pa.Table, plan: Sequence[PlannedLap], where: str) -> Practice:
    """Return which laps are practice: as recorded, else as in the plan.

    A condition that is planned for practice alone, or never, decides. Where one is practised and
    analysed, a participant who drove it as often as planned did so in the planned order; one who
    did not is matched by the laps' numbers, if these agree with the plan.

    Raises
    ------
    InputError
        When nothing tells a lap of practice from one to be analysed.
    """
    said = laps["practice"].to_pylist()
    rows = zip(*(laps[c].to_pylist() for c in ("participant", "lap", "condition")), strict=True)
    everyone = [_Lap(i, *row) for i, row in enumerate(rows)]
    by_person: dict[tuple[str, str], list[_Lap]] = defaultdict(list)
    for lap in sorted(everyone, key=lambda lap: lap.number):
        by_person[lap.participant, lap.condition].append(lap)
    planned: dict[str, list[bool]] = defaultdict(list)
    for one in plan:
        planned[one.condition].append(one.practice)
    found, how = list(said), Counter[str]()
    first = first_number(laps, plan)
    for (_, condition), driven in by_person.items():
        if all(said[lap.row] is not None for lap in driven):
            continue
        for lap, is_practice in zip(
            driven, _each(driven, planned[condition], plan, first, where), strict=True
        ):
            if said[lap.row] is None:
                found[lap.row] = is_practice
                how[condition] += is_practice and len(set(planned[condition])) > 1
    remarks = tuple(
        f"{where}: column practice is missing; {n} laps of {condition} are practice by the plan, "
        f"which has {planned[condition].count(True)} of {len(planned[condition])} laps of it so"
        for condition, n in sorted(how.items())
        if n
    )
    return Practice(tuple(map(bool, found)), remarks)


def _each(
    driven: Sequence[_Lap],
    planned: Sequence[bool],
    plan: Sequence[PlannedLap],
    first: int | None,
    where: str,
) -> Sequence[bool]:
    """Return which of one participant's laps of one condition are practice."""
    if len(set(planned)) < 2:
        return [bool(planned) and planned[0]] * len(driven)
    if len(driven) == len(planned):
        return planned
    places = [] if first is None else [lap.number - first for lap in driven]
    if places and all(_planned(plan, p) == driven[0].condition for p in places):
        return [plan[place].practice for place in places]
    lap = driven[0]
    raise InputError(
        f"{where}: column practice is missing, and nothing tells which laps of {lap.condition} "
        f"{lap.participant} drove for practice: {len(driven)} of {len(planned)} planned ones; "
        "allowed: a column practice of true and false"
    )


def renumbered_answers(answers: pa.Table, laps: pa.Table) -> tuple[pa.Table, str]:
    """Return answers with the numbers of the laps that they are about, and a remark if changed.

    They are counted from another number than the laps where all of them have their lap's condition
    then, and not all of them as they are.
    """
    driven = _conditions(laps)
    rows = list(zip(*(answers[c].to_pylist() for c in _ABOUT), strict=True))
    if not rows or _agreeing(rows, driven, 0) == len(rows):
        return answers, ""
    for shift in (1, -1):
        if _agreeing(rows, driven, shift) == len(rows):
            place = answers.schema.get_field_index("lap")
            numbers = pa.array([number + shift for _, number, _ in rows], pa.int16())
            mended = answers.set_column(place, answers.schema.field(place), numbers)
            return mended, (
                f"laps of answers are counted from {-min(shift, 0)}, those of laps from "
                f"{max(shift, 0)}: matched by condition"
            )
    return answers, ""


_ABOUT = ("participant", "lap", "condition")


def contradictions(answers: pa.Table, laps: pa.Table) -> int:
    """Return how many answers have another condition than the lap they are about."""
    driven = _conditions(laps)
    rows = zip(*(answers[c].to_pylist() for c in _ABOUT), strict=True)
    return sum(driven.get((who, lap), condition) != condition for who, lap, condition in rows)


def _conditions(laps: pa.Table) -> Mapping[tuple[str, int], str]:
    rows = zip(*(laps[c].to_pylist() for c in _ABOUT), strict=True)
    return {(who, lap): condition for who, lap, condition in rows}


def _agreeing(
    rows: Sequence[tuple[str, int, str]], driven: Mapping[tuple[str, int], str], shift: int
) -> int:
    return sum(driven.get((who, lap + shift)) == condition for who, lap, condition in rows)
