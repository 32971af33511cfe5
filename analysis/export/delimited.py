"""Tables as text: values between separators, the same table the same bytes."""

import gzip
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import pyarrow as pa
import pyarrow.compute as pc

from protocols.files.csv_text import FORMULA_PATTERN


@dataclass(frozen=True, slots=True)
class Dialect:
    """How values are written.

    Attributes
    ----------
    separator
        Between two values.
    missing
        What stands for a missing value.
    true, false
        What stands for truth values.
    header
        Whether the first line has the names.
    """

    separator: str = ","
    missing: str = ""
    true: str = "true"
    false: str = "false"
    header: bool = True


CSV = Dialect()
"""As Frictionless and Psych-DS read it."""

ROWS_AT_ONCE = 5000
"""How many rows of a table are in memory as text."""


def header_line(names: list[str], dialect: Dialect = CSV) -> bytes:
    """Return the first line; empty for a dialect without one."""
    return f"{dialect.separator.join(names)}\n".encode() if dialect.header else b""


def lines(table: pa.Table, dialect: Dialect = CSV) -> bytes:
    r"""Return a table's rows, a line each, numbers with every digit they need.

    Examples
    --------
    >>> lines(pa.table({"a": [0.1, None], "b": ["x,y", "z"]}))
    b'0.1,"x,y"\n,z\n'
    """
    if not len(table):
        return b""
    columns = [_text(array.combine_chunks(), dialect) for array in table.columns]
    rows = pc.binary_join_element_wise(*columns, dialect.separator)
    return ("\n".join(rows.to_pylist()) + "\n").encode()


def write_table(path: Path, table: pa.Table, dialect: Dialect = CSV) -> None:
    """Write a whole table into a file, some rows at a time."""
    with path.open("wb") as stream:
        stream.write(header_line(table.column_names, dialect))
        for at in range(0, len(table), ROWS_AT_ONCE):
            stream.write(lines(table.slice(at, ROWS_AT_ONCE), dialect))


def _text(array: pa.Array, dialect: Dialect) -> pa.Array:
    kind = array.type
    if pa.types.is_boolean(kind):
        text = pc.if_else(array, dialect.true, dialect.false)
    elif pa.types.is_string(kind):
        text = _quoted(_no_formula(array), dialect)
    else:
        text = array.cast(pa.string())
    return pc.fill_null(text, dialect.missing)


def _no_formula(array: pa.Array) -> pa.Array:
    """Return text with an apostrophe in front where a spreadsheet would compute it."""
    begins = pc.match_substring_regex(array, FORMULA_PATTERN)
    return pc.if_else(begins, pc.binary_join_element_wise("'", array, ""), array)


def _quoted(array: pa.Array, dialect: Dialect) -> pa.Array:
    """Put text into quotes where it would be misread: separators, quotes, line breaks, nothing."""
    special = pc.match_substring_regex(array, f'[{dialect.separator}"\r\n]|^\\s|\\s$|^$')
    doubled = pc.replace_substring(array, '"', '""')
    return pc.if_else(special, pc.binary_join_element_wise('"', doubled, '"', ""), array)


@contextmanager
def zipped(path: Path) -> Iterator[IO[bytes]]:
    """Open a gzip file whose bytes depend on nothing but its content."""
    with (
        path.open("wb") as raw,
        gzip.GzipFile(filename="", mode="wb", compresslevel=6, fileobj=raw, mtime=0) as stream,
    ):
        yield stream  # type: ignore[misc]
