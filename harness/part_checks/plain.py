"""Values in a form that two runs, or two processes, can compare exactly."""

from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np


def plain(value: Any) -> Any:
    """Return a value as tuples of text: equal for equal values, down to the last bit.

    Two values that are not numbers compare equal, and so do their copies. A generator of random
    numbers counts as the same whatever was drawn from it: drawing is what it is for.

    Examples
    --------
    >>> plain(np.array([0.5, np.nan])) == plain(np.array([0.5, np.nan]))
    True
    >>> plain((1, 2.0)) == plain((1, 2.0000000000000004))
    False
    """
    if isinstance(value, np.ndarray):
        content = plain(value.tolist()) if value.dtype.hasobject else value.tobytes()
        return (str(value.dtype), value.shape, content)
    if isinstance(value, np.random.Generator):
        return "random numbers"
    if is_dataclass(value) and not isinstance(value, type):
        inner = tuple((field.name, plain(getattr(value, field.name))) for field in fields(value))
        return (type(value).__name__, inner)
    if isinstance(value, dict):
        return tuple((plain(key), plain(item)) for key, item in value.items())
    if isinstance(value, tuple | list):
        return (type(value).__name__, *map(plain, value))
    return repr(value)


def type_name(value: Any) -> str:
    """Return the name of a value's type, with its module unless it is a built-in one.

    Examples
    --------
    >>> type_name(True), type_name(np.float32(1))
    ('bool', 'numpy.float32')
    """
    kind = type(value)
    module = kind.__module__
    return kind.__qualname__ if module == "builtins" else f"{module}.{kind.__qualname__}"


def differing_fields(one: Any, other: Any) -> tuple[str, ...]:
    """Return the fields in which two dataclass instances of one type differ."""
    return tuple(
        field.name
        for field in fields(one)
        if plain(getattr(one, field.name)) != plain(getattr(other, field.name))
    )
