"""The least a study recorded elsewhere must have, and how its tables become ours."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc

from protocols.errors import InputError
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
        Columns that must be there, without a missing value unless the schema allows one.
    defaults
        Values of columns that are not there; other absent columns are all missing.
    """

    columns: tuple[Column, ...]
    required: tuple[str, ...]
    defaults: Mapping[str, Any] = field(default_factory=dict)


PARTICIPANTS = TableRules(PARTICIPANT_COLUMNS, ("participant",), {"excluded": False})
LAPS = TableRules(
    LAP_COLUMNS,
    ("participant", "lap", "condition", "completed", "lap_time_s"),
    {"practice": False},
)
SURVEYS = TableRules(
    SURVEY_COLUMNS, ("participant", "lap", "condition", "instrument", "item", "response")
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
        When a required column is absent or has a missing value, or a column cannot be turned into
        our type; names file and column.
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
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


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
    if column.name in rules.required and not column.nullable and array.null_count:
        row = pc.index(pc.is_null(array), value=True).as_py()
        raise InputError(f"{path}: column {column.name}: missing in row {row}; it must be given")
