"""Step tables that say of themselves that they are another lap's than the one they are filed under.

What a table says: columns of its own that name a participant, a lap or a condition; how long it
lasts, or its number of steps; and whose commands count in it.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from protocols.condition import Condition
from protocols.record.elsewhere.clock import spans
from protocols.record.elsewhere.numbering import read_as
from protocols.record.elsewhere.people import one_form

Key = tuple[str, int]
"""Participant and lap's number."""

OWN = ("participant", "lap", "condition")
"""Columns by which a step table can name its lap."""

LOOKED_AT = ("t_s", "control", *OWN)
"""Columns that are read to tell whose a step table is."""

_EXACT = 1.5
"""A lap's time and its steps agree within this many steps: a gate is passed within the last one."""

_HELPERS = ("demonstrator", "model")


class LapRow(NamedTuple):
    """What a lap's row says that its steps can be held against.

    Attributes
    ----------
    condition
        As the plan names it.
    helpers
        Whose commands may count beside the driver's; None where the plan does not tell.
    lasted
        How long it took by each column that has a time, s.
    steps
        Its number of steps; None where not recorded.
    """

    condition: str
    helpers: frozenset[str] | None
    lasted: tuple[float, ...]
    steps: int | None


@dataclass(frozen=True)
class Told:
    """What a step table says of itself.

    Attributes
    ----------
    own
        Distinct values of the columns that name a lap, as text; those that are not there left out.
    spans
        How long it may last, s, and one step of it, s: by unit and by where its clock starts.
    rows
        Number of steps.
    helpers
        Whose commands count in it, the driver's apart.
    """

    own: Mapping[str, tuple[str, ...]]
    spans: tuple[tuple[float, float], ...]
    rows: int
    helpers: frozenset[str]

    def fits(self, row: LapRow) -> bool | None:
        """Return whether the table can be that lap's; None where nothing tells."""
        if row.helpers is not None and self.helpers - row.helpers:
            return False
        return self.lasts(row)

    def lasts(self, row: LapRow) -> bool | None:
        """Return whether the table is as long as that lap; None where nothing tells."""
        if self.spans and row.lasted:
            return any(
                abs(span - wanted) <= _EXACT * step
                for span, step in self.spans
                for wanted in row.lasted
            )
        return None if row.steps is None else self.rows == row.steps


def told_by(table: pa.Table, t_s: NDArray[np.float64]) -> Told:
    """Return what a step table says of itself.

    Parameters
    ----------
    table
        Those columns of ``LOOKED_AT`` that it has; ``control`` always.
    t_s
        Its times as numbers, shape (n,); NaN where missing.
    """
    own = {name: _distinct(table[name]) for name in OWN if name in table.column_names}
    said = {name: values for name, values in own.items() if values}
    return Told(said, spans(t_s), len(t_s), _helping(table))


def helpers(condition: Condition | None) -> frozenset[str] | None:
    """Return whose commands may count in a condition beside the driver's; None where unknown."""
    if condition is None:
        return None
    corrected = condition.corrections is not None
    return frozenset({condition.assistant, *(["demonstrator"] if corrected else [])})


def not_planned(table: pa.Table, row: LapRow) -> str:
    """Return whose commands count in a step table although the lap's condition has no such help."""
    return "" if row.helpers is None else min(_helping(table) - row.helpers, default="")


def _helping(table: pa.Table) -> frozenset[str]:
    there = _distinct(table["control"])
    return frozenset(name for name in _HELPERS if name in there)


def _distinct(column: pa.ChunkedArray) -> tuple[str, ...]:
    """Return the distinct values of a column as text, whole floats as whole numbers."""
    values = pc.unique(column).to_pylist()
    whole = (int(v) if isinstance(v, float) and v.is_integer() else v for v in values)
    return tuple(str(v).strip() for v in whole if v is not None and v == v)  # noqa: PLR0124 - NaN


def misfiled(rows: Mapping[Key, LapRow], tables: Mapping[Key, Told]) -> dict[Key, str]:
    """Return the step tables that are not their lap's, and in words why.

    By time, tables count as exchanged only where every table of a participant that does not last
    as long as its lap lasts as long as another one of this participant (or, for whole session
    folders, of another participant), and most tables of the study last as long as their laps then:
    clocks that are started by hand fit no lap exactly.

    Parameters
    ----------
    rows
        Every lap, by participant and number.
    tables
        What the step table of each lap says; laps without one are not in it.
    """
    found = dict(_by_name(rows, tables))
    named = {key: told for key, told in tables.items() if key not in found}
    fitting = sum(told.fits(rows[key]) is True for key, told in named.items())
    moved = _moved(rows, named)
    if 2 * (fitting + len(moved)) > len(named):
        for key, to in moved.items():
            found[key] = (
                f"fits {_lap(to, key)}, and not lap {key[1]} ({_because(named[key], rows, key)}): "
                "exchanged? It is not used"
            )
    return found


def _because(told: Told, rows: Mapping[Key, LapRow], key: Key) -> str:
    row = rows[key]
    if row.helpers is not None and (others := told.helpers - row.helpers):
        return f"commands of the {min(others)} count in it"
    if told.spans and row.lasted:
        shown = min((s for s, _ in told.spans), key=lambda s: abs(s - row.lasted[0]))
        return f"it lasts {shown:.2f} s, the lap {row.lasted[0]:.2f} s"
    return f"it has {told.rows} steps, the lap {row.steps}"


def _lap(to: Key, of: Key) -> str:
    return f"lap {to[1]}" if to[0] == of[0] else f"lap {to[1]} of {to[0]}"


def _moved(rows: Mapping[Key, LapRow], tables: Mapping[Key, Told]) -> dict[Key, Key]:
    """Return the tables that fit another lap, by whose place they have."""
    by_person: dict[str, list[Key]] = defaultdict(list)
    for key in rows:
        by_person[key[0]].append(key)
    wrong = {key for key, told in tables.items() if told.fits(rows[key]) is False}
    moved: dict[Key, Key] = {}
    astray = []
    for who, keys in by_person.items():
        off = [key for key in keys if key in wrong]
        if not off:
            continue
        free = [*off, *(key for key in keys if key not in tables)]
        exchanged = _matched(off, free, rows, tables)
        moved |= exchanged
        if not exchanged and len(off) > 1 and all(key in wrong for key in keys if key in tables):
            astray.append(who)
    return moved | dict(_folders_exchanged(astray, by_person, rows, tables))


def _matched(
    off: Sequence[Key], free: Sequence[Key], rows: Mapping[Key, LapRow], tables: Mapping[Key, Told]
) -> dict[Key, Key]:
    """Return a lap for every table that is off; nothing where one of them fits none."""
    cost = np.array([[tables[t].fits(rows[lap]) is not True for lap in free] for t in off], float)
    which, place = linear_sum_assignment(cost)
    if len(which) < len(off) or cost[which, place].any():
        return {}
    return {off[i]: free[j] for i, j in zip(which, place, strict=True)}


def _folders_exchanged(
    people: Sequence[str],
    laps: Mapping[str, Sequence[Key]],
    rows: Mapping[Key, LapRow],
    tables: Mapping[Key, Told],
) -> Iterator[tuple[Key, Key]]:
    """Yield the tables of two participants, each of which fits the other's lap of that number."""

    def all_fit(one: str, other: str) -> bool:
        own = [key for key in laps[one] if key in tables]
        there = [(other, lap) for _, lap in own]
        return all(
            key in rows and tables[mine].fits(rows[key]) is True
            for mine, key in zip(own, there, strict=True)
        )

    for one, other in combinations(people, 2):
        if all_fit(one, other) and all_fit(other, one):
            for who, whose in ((one, other), (other, one)):
                yield from ((key, (whose, key[1])) for key in laps[who] if key in tables)


def _by_name(rows: Mapping[Key, LapRow], tables: Mapping[Key, Told]) -> Iterator[tuple[Key, str]]:
    """Yield the tables whose own columns name another lap, and what they say.

    What names nobody and nothing of this study, such as a device, says nothing.
    """
    people = {one_form(who): who for who, _ in rows}
    conditions = {read_as(row.condition): row.condition for row in rows.values()}
    offset = _offset(rows, tables)
    for (who, lap), told in tables.items():
        others = {
            "participant": _others(map(one_form, told.own.get("participant", ())), people, who),
            "lap": _others(told.own.get("lap", ()), _numbers(rows, who, offset), str(lap)),
            "condition": _others(
                map(read_as, told.own.get("condition", ())), conditions, rows[who, lap].condition
            ),
        }
        for column, names in others.items():
            if names:
                said = f"has {' and '.join(names[:3])} in its column {column}"
                yield (who, lap), f"{said}, and lies at lap {lap} of {who}: it is not used"
                break


def _others(said: Iterable[str], known: Mapping[str, str], own: str) -> list[str]:
    """Return what is named of this study that is not the table's own, as the study writes it."""
    return sorted({known[name] for name in said if name in known} - {own})


def _numbers(rows: Mapping[Key, LapRow], who: str, offset: int | None) -> dict[str, str]:
    """Return the numbers by which a participant's step tables can name laps."""
    if offset is None:
        return {}
    return {str(lap + offset): str(lap) for person, lap in rows if person == who}


def _offset(rows: Mapping[Key, LapRow], tables: Mapping[Key, Told]) -> int | None:
    """Return from where step tables count laps in a column of their own; None if it says nothing.

    Most tables decide. Without a majority the column still counts where it names laps.
    """
    said = [
        ((who, int(told.own["lap"][0])), lap)
        for (who, lap), told in tables.items()
        if len(told.own.get("lap", ())) == 1 and told.own["lap"][0].isdigit()
    ]
    if not said:
        return None
    offset, n = Counter(number - lap for (_, number), lap in said).most_common(1)[0]
    if 2 * n > len(said):
        return offset
    return 0 if all(named in rows for named, _ in said) else None
