"""One column of the record: what it holds, in which unit, and which values are allowed."""

from dataclasses import dataclass
from typing import Literal, get_args

import pyarrow as pa


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a recorded table.

    Attributes
    ----------
    name
        Column name; units are part of it where they could be unclear (``lap_time_s``).
    type
        Arrow type.
    description
        One sentence for the codebook.
    unit
        SI unit, or "" for a number without one.
    allowed
        Values or range in words, or "" where the type is enough.
    nullable
        Whether the value may be missing; the description tells what missing means.
    since
        Version of the record that has it first; in an older record it is missing, so it must be
        nullable.
    """

    name: str
    type: pa.DataType
    description: str
    unit: str = ""
    allowed: str = ""
    nullable: bool = False
    since: int = 1


SchemaVersion = Literal[1, 2]

SCHEMA_VERSION: SchemaVersion = 2
"""Version of the record that is written; older ones are read."""

SCHEMA_VERSIONS: tuple[SchemaVersion, ...] = get_args(SchemaVersion)


def arrow_schema(columns: tuple[Column, ...], version: int = SCHEMA_VERSION) -> pa.Schema:
    """Return the Arrow schema of a table of these columns, in their order, in a record version."""
    return pa.schema(
        [pa.field(c.name, c.type, nullable=c.nullable) for c in columns if c.since <= version]
    )


def brought_up_to_date(table: pa.Table, columns: tuple[Column, ...]) -> pa.Table | None:
    """Return a table of any record version in this version's columns; None for any other table.

    Columns of later versions are all missing.
    """
    wanted = arrow_schema(columns)
    if table.schema.equals(wanted):
        return table
    if not any(table.schema.equals(arrow_schema(columns, version)) for version in SCHEMA_VERSIONS):
        return None
    there = set(table.column_names)
    arrays = [table[c.name] if c.name in there else pa.nulls(len(table), c.type) for c in columns]
    return pa.Table.from_arrays(arrays, schema=wanted)
