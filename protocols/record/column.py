"""One column of the record: what it holds, in which unit, and which values are allowed."""

from dataclasses import dataclass

import pyarrow as pa


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a recorded table.

    Attributes
    ----------
    name
        Column name; units are part of it where a reader could doubt (``lap_time_s``).
    type
        Arrow type.
    description
        One sentence for the codebook.
    unit
        SI unit, or "" for a number without one.
    allowed
        Values or range in words, or "" where the type says it all.
    nullable
        Whether the value may be missing; the description says what missing means.
    """

    name: str
    type: pa.DataType
    description: str
    unit: str = ""
    allowed: str = ""
    nullable: bool = False


def arrow_schema(columns: tuple[Column, ...]) -> pa.Schema:
    """Return the Arrow schema of a table made of these columns, in their order."""
    return pa.schema([pa.field(c.name, c.type, nullable=c.nullable) for c in columns])
