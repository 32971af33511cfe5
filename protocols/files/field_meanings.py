"""What each field of a file means, as the docstring of its model says."""

import inspect
import re

from pydantic import BaseModel

_SECTION = re.compile(r"^Attributes\n-+\n(.*?)(?=^\S[^\n]*\n-+$|\Z)", re.MULTILINE | re.DOTALL)
_ENTRY = re.compile(r"^(\w+(?:, \w+)*)\n((?:^(?: {4}[^\n]*)?\n?)+)", re.MULTILINE)


def field_meanings(model: type[BaseModel]) -> dict[str, str]:
    """Return the meaning of a model's fields, by their names in Python.

    Parameters
    ----------
    model
        A model whose docstring, or a parent's, has an ``Attributes`` section in numpy style.

    Returns
    -------
    dict of str to str
        One line of text for each field that is described; names that share an entry share it.

    Examples
    --------
    >>> from protocols.start_noise import StartNoise
    >>> field_meanings(StartNoise)["position_m"]
    'Largest error of either coordinate, m.'
    """
    meanings: dict[str, str] = {}
    for ancestor in reversed(model.__mro__):
        section = _SECTION.search(inspect.cleandoc(ancestor.__doc__ or "") + "\n")
        for names, text in _ENTRY.findall(section[1]) if section else ():
            line = " ".join(text.replace("``", "`").split())
            meanings |= dict.fromkeys(names.split(", "), line)
    return {name: meanings[name] for name in model.model_fields if name in meanings}


def summary_of(model: type[BaseModel]) -> str:
    """Return the paragraphs of a model's docstring before its first section.

    Parameters
    ----------
    model
        Any model with a docstring of its own.

    Returns
    -------
    str
        Paragraphs as lines, an empty line between them.

    Examples
    --------
    >>> from protocols.orders import Before
    >>> summary_of(Before)
    'A rule: one condition is driven before another one.'
    """
    text = inspect.cleandoc(model.__doc__ or "").replace("``", "`")
    before = re.split(r"^\S[^\n]*\n-+$", text, maxsplit=1, flags=re.MULTILINE)[0]
    return "\n\n".join(" ".join(part.split()) for part in before.strip().split("\n\n"))
