"""Say what is allowed, and guess what was meant."""

from collections.abc import Iterable
from difflib import get_close_matches


def allowed(given: str, names: Iterable[str]) -> str:
    """Return the end of a message: the allowed names and, where one is near, a guess.

    Examples
    --------
    >>> allowed("limted", ["baseline", "limited"])
    "allowed: baseline, limited (did you mean 'limited'?)"
    """
    names = tuple(names)
    listed = f"allowed: {', '.join(names) or 'nothing'}"
    near = get_close_matches(given, names, n=1)
    return f"{listed} (did you mean '{near[0]}'?)" if near else listed
