"""The least a study recorded elsewhere must have, and how its tables become ours."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc

from protocols.files.errors import InputError
from protocols.record.column import Column
from protocols.record.steps import STEP_COLUMNS
from protocols.record.tables import LAP_COLUMNS, PARTICIPANT_COLUMNS, SURVEY_COLUMNS


@dataclass(frozen=True, slots=True)
class TableRules:
    """What is asked of a table that somebody else wrote.

    Attributes
    ----------
    columns
        The table as this version records it.
    required
        Columns that must be there, without a missing value unless they are measurements (floats)
        or the schema allows one.
    defaults
        Values of columns that are not there; other absent columns are all missing.
    key
        Columns that together name a row: no two rows may agree in all of them.
    positive
        Columns of finite numbers above 0, where they are not missing.
    """

    columns: tuple[Column, ...]
    required: tuple[str, ...]
    defaults: Mapping[str, Any] = field(default_factory=dict)
    key: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()


PARTICIPANTS = TableRules(
    PARTICIPANT_COLUMNS, ("participant",), {"excluded": False}, key=("participant",)
)
LAPS = TableRules(
    LAP_COLUMNS,
    ("participant", "lap", "condition", "completed", "lap_time_s"),
    key=("participant", "lap"),
    positive=("lap_time_s",),
)
SURVEYS = TableRules(
    SURVEY_COLUMNS,
    ("participant", "lap", "condition", "instrument", "item", "response"),
    key=("participant", "lap", "instrument", "item"),
)
STEPS = TableRules(STEP_COLUMNS, ("t_s", "x_m", "y_m"))


def conform(
    table: pa.Table, rules: TableRules, path: Path, columns: Sequence[str] | None = None
) -> pa.Table:
    """Return a table with our columns, in our order and types, then any others it has.

    Parameters
    ----------
    table
        As it was read.
    rules
        What is asked of it.
    path
        Its file, for messages.
    columns
        Only these columns; None for all of ours and any others.

    Raises
    ------
    InputError
        When a required column is absent or has a missing value, a column cannot be turned into our
        type, a number is out of range, or a row is there twice; names file and column or row.
    """
    there = set(table.column_names)
    absent = [name for name in rules.required if name not in there]
    if absent:
        raise InputError(
            f"{path}: column {absent[0]} is missing; required: {', '.join(rules.required)}"
        )
    arrays, fields = [], []
    for column in rules.columns:
        if columns is not None and column.name not in columns:
            continue
        if column.name in there:
            array = _converted(table[column.name], column, path)
            _check_missing(array, column, rules, path)
        else:
            default = rules.defaults.get(column.name)
            array = pa.chunked_array([pa.array([default] * len(table), column.type)])
        arrays.append(array)
        fields.append(pa.field(column.name, column.type, array.null_count > 0 or column.nullable))
    ours = {column.name for column in rules.columns}
    for name in table.column_names:
        if name not in ours and (columns is None or name in columns):
            arrays.append(table[name])
            fields.append(table.schema.field(name))
    ready = pa.Table.from_arrays(arrays, schema=pa.schema(fields))
    _check_range(ready, rules, path)
    _check_key(ready, rules, path)
    return ready


def _converted(array: pa.ChunkedArray, column: Column, path: Path) -> pa.ChunkedArray:
    if array.type.equals(column.type):
        return array
    try:
        # What pandas writes for integers with gaps: floats, and NaN for the gaps.
        if pa.types.is_floating(array.type) and not pa.types.is_floating(column.type):
            array = pc.if_else(pc.is_nan(array), None, array)
        return array.cast(column.type)
    except (pa.ArrowInvalid, pa.ArrowNotImplementedError) as error:
        reason = str(error).partition("\n")[0]
        raise InputError(
            f"{path}: column {column.name} is {array.type}; allowed: {column.type} ({reason})"
        ) from None


def _check_missing(array: pa.ChunkedArray, column: Column, rules: TableRules, path: Path) -> None:
    # A missing measurement is a gap in the analysis; without a key, nobody knows whose row it is.
    if pa.types.is_floating(column.type):
        return
    if column.name in rules.required and not column.nullable and array.null_count:
        row = pc.index(pc.is_null(array), value=True).as_py()
        raise InputError(f"{path}: column {column.name}: missing in row {row}; it must be given")


def _check_range(table: pa.Table, rules: TableRules, path: Path) -> None:
    for name in set(rules.positive) & set(table.column_names):
        values = table[name]
        wrong = pc.invert(pc.and_(pc.greater(values, 0), pc.is_finite(values)))
        # NaN is how pandas writes a missing number.
        row = pc.index(pc.and_not(wrong, pc.is_nan(values)), value=True).as_py()
        if row >= 0:
            value = values[row].as_py()
            raise InputError(f"{path}: column {name}: {value} in row {row}; allowed: above 0")


def _check_key(table: pa.Table, rules: TableRules, path: Path) -> None:
    key = list(rules.key)
    if not key or not set(key) <= set(table.column_names):
        return
    counted = table.group_by(key).aggregate([([], "count_all")])
    again = counted.filter(pc.greater(counted["count_all"], 1))
    if len(again):
        row = ", ".join(f"{name} {again[name][0]}" for name in key)
        raise InputError(f"{path}: {again['count_all'][0]} rows of {row}; allowed: one")
