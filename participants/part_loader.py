"""Find the factory that a protocol names: a shipped part's, or somebody's own."""

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from protocols.files.errors import InputError
from protocols.files.suggestion import allowed

FACTORY_PATH = "package.module:factory"


def load_factory(role: str, shipped: Mapping[str, str], name: str) -> Any:
    """Return the function that makes a part.

    Parameters
    ----------
    role
        What the part is, for messages: driver, demonstrator, model, ...
    shipped
        Where the factories of the shipped parts are, by name.
    name
        As the protocol has it: a shipped name, or a dotted path ``package.module:factory``.

    Raises
    ------
    InputError
        When no part is called so, its module cannot be imported, or has no such function.
    """
    hint = allowed(name, shipped, [FACTORY_PATH])
    module_name, colon, attribute = shipped.get(name, name).partition(":")
    if not colon:
        raise InputError(f"{role} {name!r}: no {role} is called so; {hint}")
    try:
        module = import_module(module_name)
    except Exception as error:  # other people's modules may fail in any way
        reason = f"{type(error).__name__}: {error}".splitlines()[0]
        raise InputError(
            f"{role} {name!r}: cannot import {module_name!r} ({reason}); {hint}"
        ) from error
    factory = getattr(module, attribute, None)
    if not callable(factory):
        raise InputError(f"{role} {name!r}: {module_name!r} has no function {attribute!r}; {hint}")
    return factory


def refuse_missing_methods(role: str, name: str, made: object, methods: tuple[str, ...]) -> None:
    """Refuse what a factory made when it lacks a method of its role.

    Raises
    ------
    InputError
        Names the methods.
    """
    missing = [method for method in methods if not callable(getattr(made, method, None))]
    if missing:
        raise InputError(f"{role} {name!r}: is no {role}, it lacks {', '.join(missing)}")
