"""What a scalar of a YAML file is: text, a number, a truth value or nothing."""

import re
from collections.abc import Callable
from functools import cache, lru_cache
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.nodes import ScalarNode

TAG = "tag:yaml.org,2002:"
MERGE = f"{TAG}merge"
MAX_DIGITS = 400
"""Characters that a number may have: no finite one needs more."""

_INT, _FLOAT = f"{TAG}int", f"{TAG}float"
_PLAIN_INT = re.compile(r"[-+]?(?:0|[1-9][0-9]*)")
_PLAIN_FLOAT = re.compile(r"[-+]?[0-9]+\.[0-9]*")
"""What nearly every number looks like, in every version of YAML; the others take longer."""

_CONSTANTS = {"true": True, "false": False, "yes": True, "no": False, "on": True, "off": False}
_TEXTS = ("str", "timestamp", "value")


class ScalarError(ValueError):
    """A scalar does not fit its tag, or its tag is not allowed."""


def tag_of(value: str, version: tuple[int, int] | None) -> str:
    """Return the tag of a plain scalar.

    Parameters
    ----------
    value
        As it is in the file.
    version
        The file's own version of YAML; None for 1.2.

    Examples
    --------
    >>> tag_of("0.5", None), tag_of("yes", None), tag_of("yes", (1, 1))
    ('tag:yaml.org,2002:float', 'tag:yaml.org,2002:str', 'tag:yaml.org,2002:bool')
    """
    if _PLAIN_INT.fullmatch(value) and version is None:
        return _INT
    if _PLAIN_FLOAT.fullmatch(value):
        return _FLOAT
    return _resolved(value, version)


def scalar_value(tag: str, value: str, version: tuple[int, int] | None) -> Any:
    """Return a scalar as a plain value.

    Raises
    ------
    ScalarError
        When it cannot be one, with the reason.
    """
    kind = tag.removeprefix(TAG)
    if kind == "null":
        return None
    if kind == "bool" and value.lower() in _CONSTANTS:
        return _CONSTANTS[value.lower()]
    if kind in _TEXTS:
        return value
    if kind in {"int", "float"}:
        return _number(kind, value, version)
    raise ScalarError(f"the tag {short(tag)} is not allowed")


def short(text: str, longest: int = 60) -> str:
    """Return a text of a file, short enough for a message."""
    return text if len(text) <= longest else f"{text[: longest - 3]}..."


def _number(kind: str, value: str, version: tuple[int, int] | None) -> float:
    if len(value) > MAX_DIGITS:
        raise ScalarError(f"{short(value)} is not a number")
    try:
        if _PLAIN_INT.fullmatch(value) and version is None:
            return int(value)
        if _PLAIN_FLOAT.fullmatch(value) and kind == "float":
            return float(value)
        constructor = _yaml(version).constructor
        read: Callable[[ScalarNode], float] = getattr(constructor, f"construct_yaml_{kind}")
        return read(ScalarNode(f"{TAG}{kind}", value))
    except ValueError:
        raise ScalarError(f"{short(value)} is not a number") from None


@lru_cache(maxsize=4096)
def _resolved(value: str, version: tuple[int, int] | None) -> str:
    return str(_yaml(version).resolver.resolve(ScalarNode, value, (True, False)))


@cache
def _yaml(version: tuple[int, int] | None) -> YAML:
    """Return what knows the rules of a version; made once, for it costs more than a number."""
    yaml = YAML(typ="safe", pure=True)
    yaml.version = version
    return yaml
