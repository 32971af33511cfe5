"""A questionnaire export as text: nothing is taken for a number or a missing value."""

import csv
import io
from dataclasses import dataclass
from pathlib import Path

from protocols.files.errors import InputError
from protocols.importing.answers.mapping import AnswersMapping


@dataclass(frozen=True, slots=True)
class Sheet:
    """Names and rows.

    Attributes
    ----------
    path
        The file.
    names
        Of the columns.
    rows
        Line in the file, and the row's text by column.
    """

    path: Path
    names: tuple[str, ...]
    rows: tuple[tuple[int, dict[str, str]], ...]


def read_sheet(path: Path, mapping: AnswersMapping) -> Sheet:
    """Read a file.

    Raises
    ------
    InputError
        When it cannot be read, is of another encoding or separator, or a row has too many values.
    """
    text = _text(path, mapping.encoding)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=mapping.separator, strict=True)
    try:
        names = next(reader, [])
        if len(names) < 2:
            raise InputError(
                f"{path}:1: {len(names)} column; is the separator {mapping.separator!r} right? "
                r"allowed: ',', ';' or a tabulator ('\t') as separator in the mapping"
            )
        again = [name for i, name in enumerate(names) if name and name in names[:i]]
        if again:
            raise InputError(f"{path}:1: column {again[0]!r} is there twice; names must differ")
        rows = [
            (reader.line_num, _row(path, reader.line_num, names, values))
            for values in reader
            if values
        ]
    except csv.Error as error:
        raise InputError(f"{path}:{reader.line_num}: not a table: {error}") from None
    return Sheet(path, tuple(names), tuple(rows[mapping.skip_rows :]))


def _text(path: Path, encoding: str) -> str:
    try:
        content = path.read_bytes()
        return content.decode("utf-8-sig" if encoding == "utf-8" else encoding)
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise InputError(
            f"{path}:{line}: not {encoding} text; allowed: another encoding in the mapping "
            "(utf-8, utf-16, latin-1, cp1252)"
        ) from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None


def _row(path: Path, line: int, names: list[str], values: list[str]) -> dict[str, str]:
    if len(values) > len(names):
        raise InputError(
            f"{path}:{line}: {len(values)} values; allowed: {len(names)}, one a column"
        )
    padded = [*values, *[""] * (len(names) - len(values))]
    return dict(zip(names, (value.strip() for value in padded), strict=True))
