"""The factory that a person names on the command line: their own code, named by themselves."""

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from protocols.files.errors import InputError
from protocols.files.suggestion import allowed
from protocols.parts import installed_part

FACTORY_PATH = "module:factory"


def named_factory(role: str, shipped: Mapping[str, str], part: str) -> Any:
    """Return the function that makes a part.

    A protocol may name less: who types a name here runs their own code, so any module will do.

    Parameters
    ----------
    role
        What the part is, for messages.
    shipped
        Where the factories of the shipped parts are, by name.
    part
        A shipped name, an installed package's, or ``module:factory``.

    Raises
    ------
    InputError
        When no part is called so, its module cannot be imported, or has no such function.
    """
    hint = allowed(part, shipped, [FACTORY_PATH])
    installed = installed_part(part)
    path = shipped.get(part, installed.value if installed else part)
    module_name, colon, attribute = path.partition(":")
    if not colon:
        raise InputError(f"{role} {part!r}: no {role} is called so; {hint}")
    try:
        module = import_module(module_name)
    except Exception as error:  # other people's modules may fail in any way
        reason = f"{type(error).__name__}: {error}".splitlines()[0]
        raise InputError(
            f"{role} {part!r}: cannot import {module_name!r} ({reason}); {hint}"
        ) from error
    factory = getattr(module, attribute, None)
    if not callable(factory):
        raise InputError(f"{role} {part!r}: {module_name!r} has no function {attribute!r}; {hint}")
    return factory
