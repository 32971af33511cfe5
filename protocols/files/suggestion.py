"""List what is allowed, and guess what was meant."""

from collections.abc import Iterable, Sequence
from difflib import get_close_matches

LONGEST_GUESS = 200
"""Characters up to which a misspelt word is guessed at."""


def allowed(given: str, names: Iterable[str], kinds: Iterable[str] = ()) -> str:
    """Return the end of a message: the allowed names and, where one is near, a guess.

    Other ``kinds`` that are allowed, such as a file, come first and are never a guess.

    Examples
    --------
    >>> allowed("limted", ["baseline", "limited"])
    "allowed: baseline, limited (did you mean 'limited'?)"
    """
    names = tuple(names)
    listed = f"allowed: {', '.join((*kinds, *names)) or 'nothing'}"
    near = get_close_matches(given, names, n=1) if len(given) <= LONGEST_GUESS else []
    return f"{listed} (did you mean '{near[0]}'?)" if near else listed


def listed(names: Sequence[str]) -> str:
    """Return the end of a message: the names there are; a long list is shortened.

    Examples
    --------
    >>> listed(["P0001", "P0002"])
    'allowed: P0001, P0002'
    >>> listed([f"P{n:04d}" for n in range(1, 500)])
    'allowed: P0001, P0002, P0003, ..., P0499 (499 in all)'
    """
    if len(names) > 12:
        return f"allowed: {', '.join(names[:3])}, ..., {names[-1]} ({len(names)} in all)"
    return f"allowed: {', '.join(names) or 'nothing'}"
