"""How another program's table becomes ours: columns, types, ranges and keys."""

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import pyarrow as pa
import pyarrow.compute as pc

from protocols.files.errors import InputError
from protocols.record.column import Column
from protocols.record.elsewhere.rules import Range, TableRules
from protocols.record.elsewhere.values import converted


class Conformed(NamedTuple):
    """A table in our form, and in words what was repaired on the way."""

    table: pa.Table
    remarks: tuple[str, ...] = ()


def conform(
    table: pa.Table, rules: TableRules, path: Path, columns: Sequence[str] | None = None
) -> Conformed:
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

    Returns
    -------
    Conformed
        The table, and a remark for a column or row that was there twice, or is left out.

    Raises
    ------
    InputError
        When a required column is absent or has a missing value, a column cannot be turned into our
        type, a number is out of range, or two rows with one key differ; names file and column or
        row.
    """
    table, remarks = _once(table, path)
    there = dict(zip(table.column_names, table.columns, strict=True))
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
            array = converted(there[column.name], column, path, clock=column.name in rules.clocks)
            _check_missing(array, column, rules, path)
        else:
            array = pa.chunked_array([pa.nulls(len(table), column.type)])
        arrays.append(array)
        fields.append(pa.field(column.name, column.type, array.null_count > 0 or column.nullable))
    ours = {column.name for column in rules.columns}
    for name, array in there.items():
        if name in ours or (columns is not None and name not in columns):
            continue
        if _is_simple(array.type):
            arrays.append(array)
            fields.append(table.schema.field(name).remove_metadata())
        else:
            remarks += (f"{path.name}: column {name} is {array.type}; it is left out",)
    ready = pa.Table.from_arrays(arrays, schema=pa.schema(fields))
    _check_ranges(ready, rules, path)
    ready, repeated = one_row_each(ready, rules, path)
    return Conformed(ready, (*remarks, *repeated))


def _once(table: pa.Table, path: Path) -> tuple[pa.Table, tuple[str, ...]]:
    """Return the table with every column once; refuse two of one name that differ."""
    if len(set(table.column_names)) == table.num_columns:
        return table, ()
    remarks: list[str] = []
    again = [name for name, n in Counter(table.column_names).items() if n > 1]
    for name in again:
        places = [i for i, other in enumerate(table.column_names) if other == name]
        first, *others = (table.column(i) for i in places)
        if any(not first.equals(other) for other in others):
            raise InputError(f"{path}: column {name} is there {len(places)} times; allowed: once")
        for i in reversed(places[1:]):
            table = table.remove_column(i)
        remarks.append(f"{path.name}: column {name} is there {len(places)} times with one content")
    return table, tuple(remarks)


def _is_simple(kind: pa.DataType) -> bool:
    """Return whether an additional column can be kept: one plain value in each row."""
    if pa.types.is_dictionary(kind):
        kind = kind.value_type
    return bool(
        pa.types.is_integer(kind)
        or pa.types.is_floating(kind)
        or pa.types.is_boolean(kind)
        or pa.types.is_decimal(kind)
        or pa.types.is_temporal(kind)
        or pa.types.is_string(kind)
        or pa.types.is_large_string(kind)
    )


def _check_missing(array: pa.ChunkedArray, column: Column, rules: TableRules, path: Path) -> None:
    # A missing measurement is a gap in the analysis; without a key, it is unknown whose row it is.
    if pa.types.is_floating(column.type):
        return
    if column.name in rules.required and not column.nullable and array.null_count:
        row = pc.index(pc.is_null(array), value=True).as_py()
        raise InputError(f"{path}: column {column.name}: missing in row {row}; it must be given")
    if column.name in rules.key and pa.types.is_string(column.type):
        row = pc.index(pc.equal(pc.utf8_trim_whitespace(array), ""), value=True).as_py()
        if row >= 0:
            raise InputError(f"{path}: column {column.name}: empty in row {row}; it must be given")


def _check_ranges(table: pa.Table, rules: TableRules, path: Path) -> None:
    for name, allowed in rules.ranges.items():
        if name not in table.column_names:
            continue
        values = table[name]
        # NaN is how pandas writes a missing number.
        given = values if not pa.types.is_floating(values.type) else _no_nan(values)
        row = pc.index(pc.invert(_within(given, allowed)), value=True).as_py()
        if row >= 0:
            value = values[row].as_py()
            raise InputError(
                f"{path}: column {name}: {value} in row {row}; allowed: {allowed.words}"
            )


def _no_nan(values: pa.ChunkedArray) -> pa.ChunkedArray:
    return pc.if_else(pc.is_nan(values), None, values)


def _within(values: pa.ChunkedArray, allowed: Range) -> pa.ChunkedArray:
    above = pc.greater if allowed.open_low else pc.greater_equal
    right = pc.and_(above(values, allowed.low), pc.is_finite(values))
    return right if allowed.high is None else pc.and_(right, pc.less_equal(values, allowed.high))


def one_row_each(
    table: pa.Table, rules: TableRules, path: Path
) -> tuple[pa.Table, tuple[str, ...]]:
    """Return the table with each row once, and a remark where one was there more than once.

    Raises
    ------
    InputError
        When two rows of one key differ.
    """
    key = list(rules.key)
    if not key or not set(key) <= set(table.column_names):
        return table, ()
    counted = table.group_by(key).aggregate([([], "count_all")])
    if not pc.any(pc.greater(counted["count_all"], 1), min_count=0).as_py():
        return table, ()
    rows = _by_key(table, key)
    for where, found in rows.items():
        if len({str(content) for _, content in found}) > 1:
            row = ", ".join(f"{name} {value}" for name, value in zip(key, where, strict=True))
            raise InputError(f"{path}: {len(found)} rows of {row}; allowed: one")
    kept = sorted(found[0][0] for found in rows.values())
    more = len(table) - len(kept)
    remark = f"{path.name}: rows that are there more than once, all the same, count once"
    return table.take(kept), (f"{remark} ({more} left out)",)


def _by_key(
    table: pa.Table, key: Iterable[str]
) -> dict[tuple[object, ...], list[tuple[int, object]]]:
    found: dict[tuple[object, ...], list[tuple[int, object]]] = {}
    for i, row in enumerate(table.to_pylist()):
        found.setdefault(tuple(row[name] for name in key), []).append((i, row))
    return found
