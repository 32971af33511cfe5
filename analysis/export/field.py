"""A column as other formats describe it: its kind, unit and limits, from the codebook."""

import re
from dataclasses import dataclass, replace
from typing import Literal

import pyarrow as pa

from protocols.record.column import Column

Kind = Literal["string", "integer", "number", "boolean"]

_RANGE = re.compile(r"^(-?[\d.]+) to (-?[\d.]+)$")
_LEAST = re.compile(r"^(-?[\d.]+) or more$")
_NUMBER = re.compile(r"^[+-]?[\d.]+$")
_WORD = re.compile(r"^[a-z_]+$")


@dataclass(frozen=True, slots=True)
class Field:
    """A column of an exported table.

    Attributes
    ----------
    name, description, unit
        As in the codebook.
    kind
        Of its values.
    type
        Arrow type of its values.
    nullable
        Whether a value may be missing.
    values
        The only allowed values; empty for no such list.
    minimum, maximum
        Limits, both allowed themselves; None for no limit.
    above
        A limit that is not itself allowed; None for no limit.
    """

    name: str
    kind: Kind
    type: pa.DataType
    description: str
    unit: str = ""
    nullable: bool = False
    values: tuple[str, ...] | tuple[int, ...] = ()
    minimum: float | None = None
    maximum: float | None = None
    above: float | None = None


def field_of(column: Column) -> Field:
    """Return a codebook column as a field, its limits read from the words of the codebook.

    Parameters
    ----------
    column
        Of the record. A number of 64 bits without a sign becomes text: R and JavaScript round it.

    Examples
    --------
    >>> field_of(Column("share", pa.float64(), "A share", "", "0 to 1")).maximum
    1.0
    >>> field_of(Column("h", pa.int8(), "Takeover", "", "-1, +1", nullable=True)).values
    (-1, 1)
    """
    kind = pa.string() if pa.types.is_uint64(column.type) else column.type
    field = Field(
        column.name, kind_of(kind), kind, column.description, column.unit, column.nullable
    )
    words = column.allowed
    if found := _RANGE.match(words):
        return replace(field, minimum=float(found[1]), maximum=float(found[2]))
    if found := _LEAST.match(words):
        return replace(field, minimum=float(found[1]))
    if words.startswith("above "):
        return replace(field, above=float(words.removeprefix("above ")))
    entries = words.split(", ")
    if all(map(_NUMBER.match, entries)):
        return replace(field, values=tuple(int(entry) for entry in entries))
    if len(entries) > 1 and all(map(_WORD.match, entries)):
        return replace(field, values=tuple(entries))
    return field


def kind_of(kind: pa.DataType) -> Kind:
    """Return what other formats call an Arrow type.

    Raises
    ------
    TypeError
        When a column of this type is not one value.
    """
    if pa.types.is_boolean(kind):
        return "boolean"
    if pa.types.is_integer(kind):
        return "integer"
    if pa.types.is_floating(kind):
        return "number"
    if pa.types.is_string(kind):
        return "string"
    raise TypeError(f"{kind} is not one value")
