"""Characters for which the figures' font has no letter, by their script."""

import unicodedata
from collections.abc import Iterable
from functools import cache

import matplotlib.font_manager as fonts
from matplotlib import ft2font
from matplotlib.figure import Figure
from matplotlib.ft2font import FT2Font
from matplotlib.text import Text

_JOINED = ("ARABIC", "SYRIAC", "DEVANAGARI", "BENGALI", "TAMIL", "THAI", "KHMER", "MYANMAR")
"""Scripts whose letters change with their neighbours."""

_JOINS = hasattr(ft2font, "__libraqm_version__")
"""Whether the figures' drawing joins such letters, and writes from right to left: from matplotlib
3.11 on."""


def missing_scripts(texts: Iterable[str]) -> tuple[str, ...]:
    """Return the scripts of which some characters cannot be drawn as they are written, sorted.

    Parameters
    ----------
    texts
        What is written.

    Examples
    --------
    >>> missing_scripts(["Pauline's 5 µm — fine"])
    ()
    >>> missing_scripts(["很好", "ดี"])
    ('CJK', 'Thai')
    """
    found = set()
    for character in set("".join(texts)):
        script = script_of(character)
        joined = script.upper() in _JOINED and not _JOINS
        if script and (joined or ord(character) not in _letters()):
            found.add(script)
    return tuple(sorted(found))


def figure_scripts(figure: Figure) -> tuple[str, ...]:
    """Return the same of every text in a figure."""
    return missing_scripts(str(text.get_text()) for text in figure.findobj(Text))


def script_of(character: str) -> str:
    """Return the script of a character as its name in Unicode begins; "" of none that is seen.

    Examples
    --------
    >>> script_of("a"), script_of("字"), script_of("😀"), script_of(" ")
    ('Latin', 'CJK', 'emoji', '')
    """
    category = unicodedata.category(character)
    if category[0] in "ZC":
        return ""
    if category in ("So", "Sk"):
        return "emoji"
    first = unicodedata.name(character, "unnamed characters").split()[0].split("-")[0]
    return first if first == "CJK" else first.capitalize()


@cache
def _letters() -> frozenset[int]:
    """Return the characters that the font which matplotlib ships has."""
    return frozenset(FT2Font(fonts.findfont("DejaVu Sans")).get_charmap())
