"""Tables of one study joined with one another and with the plan; every repair has a remark."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow as pa

from protocols.files.errors import InputError
from protocols.record.elsewhere.conform import Conformed, one_row_each
from protocols.record.elsewhere.numbering import (
    contradictions,
    first_number,
    practice,
    renumbered_answers,
    with_known_conditions,
)
from protocols.record.elsewhere.people import with_known_ids
from protocols.record.elsewhere.rules import LAPS, SURVEYS, TableRules
from protocols.study import StudyProtocol

_LONGEST = 3600.0
"""The longest time limit that a lap may have, s."""

_THOUSAND = 800.0, 1250.0
"""A ratio of two times in between means that one of them is in milliseconds."""


def joined_laps(
    laps: Conformed, participants: pa.Table, protocol: StudyProtocol, path: Path
) -> Conformed:
    """Return the laps of a study from elsewhere, matched with its participants and its plan.

    Raises
    ------
    InputError
        When nothing tells which laps are practice, or two columns of times contradict each other.
    """
    table, remarks = _known(laps, LAPS, participants, protocol, path)
    _refuse_two_units(table, path)
    if first_number(table, protocol.laps) == 1:
        remarks.append(f"{path.name}: laps are counted from 1")
    return Conformed(table, tuple(remarks))


def with_practice(laps: Conformed, protocol: StudyProtocol, path: Path) -> Conformed:
    """Return laps with which of them are practice.

    Raises
    ------
    InputError
        When nothing tells.
    """
    if not laps.table["practice"].null_count:
        return laps
    found = practice(laps.table, protocol.laps, str(path))
    place = laps.table.schema.get_field_index("practice")
    field = pa.field("practice", pa.bool_())
    table = laps.table.set_column(place, field, pa.array(found.column, pa.bool_()))
    return Conformed(table, (*laps.remarks, *(r.replace(str(path), path.name) for r in found[1])))


def joined_answers(
    answers: Conformed,
    laps: pa.Table,
    participants: pa.Table,
    protocol: StudyProtocol,
    path: Path,
) -> Conformed:
    """Return the answers of a study from elsewhere, matched with its participants and laps."""
    table, remarks = _known(answers, SURVEYS, participants, protocol, path)
    table, renumbered = renumbered_answers(table, laps)
    if renumbered:
        remarks.append(f"{path.name}: {renumbered}")
    if against := contradictions(table, laps):
        remarks.append(
            f"{path.name}: {against} answers have another condition than their lap in laps.parquet;"
            " the condition beside the answer counts"
        )
    return Conformed(table, tuple(remarks))


def _known(
    given: Conformed,
    rules: TableRules,
    participants: pa.Table,
    protocol: StudyProtocol,
    path: Path,
) -> tuple[pa.Table, list[str]]:
    table, remarks = given.table, list(given.remarks)
    table, rows = with_known_ids(table, participants["participant"].to_pylist())
    if rows:
        remarks.append(
            f"{path.name}: {rows} rows have an id that differs from the one in "
            "participants.parquet only in blanks or in how letters are coded: taken for one person"
        )
    table, renamed = with_known_conditions(table, protocol.conditions)
    if renamed:
        remarks.append(f"{path.name}: {renamed}")
    if rows or renamed:  # two rows may have become one
        table, repeated = one_row_each(table, rules, path)
        remarks += repeated
    return table, remarks


def _refuse_two_units(laps: pa.Table, path: Path) -> None:
    """Refuse lap times and durations of which one set is in milliseconds."""
    times, durations = (_numbers(laps, name) for name in ("lap_time_s", "duration_s"))
    both = np.isfinite(times) & np.isfinite(durations) & (durations > 0)
    if not both.any():
        return
    ratio = float(np.median(times[both] / durations[both]))
    low, high = _THOUSAND
    if low <= ratio <= high or low <= 1 / ratio <= high:
        longer, shorter = ("lap_time_s", "duration_s")[:: 1 if ratio > 1 else -1]
        raise InputError(
            f"{path}: column {longer} is a thousand times {shorter}; allowed: both in seconds"
        )


def doubtful_times(laps: pa.Table) -> Iterator[str]:
    """Name laps of which times are hardly seconds, or contradict each other, in words."""
    times, durations = (_numbers(laps, name) for name in ("lap_time_s", "duration_s"))
    if n := int((np.fmax(times, durations) > _LONGEST).sum()):
        yield f"{n} laps took longer than an hour by lap_time_s or duration_s: are these seconds?"
    done = np.array(laps["completed"].to_pylist(), dtype=bool)
    apart = done & (np.abs(times - durations) > np.maximum(1.0, 0.05 * durations))
    if apart.any():
        yield f"lap_time_s and duration_s of {int(apart.sum())} finished laps contradict each other"


def unlike_completed(completed: np.ndarray, timed: np.ndarray) -> Iterator[str]:
    """Name, in words, lap times that are there although the lap was not finished, and the reverse.

    Parameters
    ----------
    completed, timed
        Which laps were finished, and which have a lap time: flags, shape (n,).
    """
    for n, one, what in (
        (int((~completed & timed).sum()), "lap time", "of laps that were not finished"),
        (int((completed & ~timed).sum()), "finished lap", "without a lap time"),
    ):
        if n:
            yield f"{n} {one if n == 1 else one + 's'} {what}"


def _numbers(table: pa.Table, name: str) -> np.ndarray:
    values = table[name].cast(pa.float64()).to_numpy()
    return np.asarray(values, dtype=np.float64)
