"""Rows as CSV that a spreadsheet shows as what they are: text is never a formula."""

import csv
import io
import re
from collections.abc import Iterable, Sequence

_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠")
"""What a spreadsheet may take for the beginning of a formula, wide forms included."""

FORMULA_PATTERN = f"^ *[{re.escape(''.join(_FORMULA))}]"
"""The same as a regular expression, blanks in front included."""


def csv_text(rows: Iterable[Sequence[object]]) -> str:
    r"""Return rows as CSV; text that begins like a formula has an apostrophe in front.

    Numbers stay as they are. The apostrophe is what spreadsheets themselves put before text.

    Parameters
    ----------
    rows
        Of text, numbers, truth values and None (an empty cell).

    Examples
    --------
    >>> csv_text([("name", "s"), ("=1+1", -2.5)])
    "name,s\n'=1+1,-2.5\n"
    """
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerows([harmless(cell) for cell in row] for row in rows)
    return text.getvalue()


def harmless(cell: object) -> object:
    """Return a cell that no spreadsheet takes for a formula."""
    if isinstance(cell, str) and cell.lstrip(" ").startswith(_FORMULA):
        return f"'{cell}"
    return cell
