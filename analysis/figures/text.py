"""Text in figures is text: it is drawn as it was written, where there is room for it."""

import re
import textwrap
import unicodedata
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.text import Text

_LETTER = 0.62
"""How wide a letter of DejaVu Sans is, as a share of the size; 0.6 on the average."""


@contextmanager
def literal_text() -> Iterator[None]:
    """Draw without reading dollar signs as mathematics, and without a word about missing glyphs.

    A character that no font has is drawn as a box; ``missing_letters`` says of which scripts.
    """
    plain = mpl.rc_context({"text.parse_math": False, "text.usetex": False})
    with plain, warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from (current )?font")
        yield


def make_literal(figure: Figure) -> None:
    """Take away, from every text that a figure has, what would make mathematics of it."""
    for text in figure.findobj(Text):
        text.set_parse_math(False)


def wrapped(text: str, width: int, lines: int | None = None) -> str:
    r"""Return text broken into lines; a word that is longer than one is broken, too.

    Parameters
    ----------
    text
        What was written.
    width
        Characters per line, 1 or more.
    lines
        How many at most; the last one ends with three dots then. None for all.

    Examples
    --------
    >>> wrapped("human-assisted", 8)
    'human-\nassisted'
    >>> wrapped("a b c d e f", 3, lines=2)
    'a b\n...'
    """
    # A Chinese or Japanese character takes the room of two Latin ones.
    double = sum(unicodedata.east_asian_width(character) in "WF" for character in text)
    width = max(width * len(text) // (len(text) + double), 1) if double else width
    return "\n".join(textwrap.wrap(text, width, max_lines=lines, placeholder="...") or [""])


def label_room(names: Sequence[str], least: float, size: float = 9.0) -> float:
    """Return how wide each of some labels side by side has to be so that its words stay whole.

    Parameters
    ----------
    names
        From left to right.
    least
        Least width of each, inches.
    size
        Of the letters, points.

    Returns
    -------
    float
        Inches; words of more than 16 letters are not waited for.

    Examples
    --------
    >>> label_room(["limited", "human-assisted"], 0.9)
    0.9
    >>> round(label_room(["the demonstrator helps"], 0.9), 2)
    1.01
    """
    words = [word for name in names for word in re.split(r"\s+|(?<=-)", name)]
    longest = min(max(map(len, words), default=0), 16)
    return max(least, (longest + 1) * _LETTER * size / 72)


def label_lines(names: Sequence[str], inches: float, size: float = 9.0) -> list[str]:
    """Return labels to stand side by side below an axis, broken so that none meets its neighbour.

    Parameters
    ----------
    names
        From left to right.
    inches
        Room for all of them.
    size
        Of the letters, points.
    """
    room = letters_in(inches / max(len(names), 1), size)
    return [wrapped(name, max(room, 3), lines=6) for name in names]


def letters_in(inches: float, size: float = 9.0) -> int:
    """Return how many letters of a size in points have room in a line.

    Examples
    --------
    >>> letters_in(1.0)
    12
    """
    return int(72 * inches / (_LETTER * size))
