"""Find the factory that a protocol names: a shipped part's, an installed one's, or one beside it.

Nothing else can be named, and code beside a protocol file is run only when a person has confirmed
that it may be, and only as it was then.
"""

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from protocols.code_beside import PartBeside, code_digest
from protocols.files.errors import InputError
from protocols.parts import installed_part, unknown_part
from protocols.shipped_parts import Role, shipped_factory

_LOADED: dict[tuple[Path, str], ModuleType] = {}
"""Modules beside protocols that this process has run, by file and content."""


def load_factory(role: Role, use: str, code: Sequence[PartBeside] = ()) -> Any:
    """Return the function that makes a part.

    Parameters
    ----------
    role
        What the part is.
    use
        As the protocol has it.
    code
        The parts beside the protocol file that may be run.

    Raises
    ------
    InputError
        When no part is called so, its code may not be run, cannot be imported (also one of ours
        whose extra is not installed), or has no such function.
    """
    shipped = shipped_factory(role, use)
    if shipped is not None:
        try:
            return shipped_function(shipped)
        except ImportError as error:  # an extra that is not installed says how to get it
            raise _unloadable(role, use, shipped, error) from error
    attribute = use.partition(":")[2]
    beside = next((part for part in code if part.use == use), None)
    if beside is not None:
        return _function(role, use, _beside(role, beside), attribute)
    installed = installed_part(use)
    if installed is None:
        hint = "; code beside a protocol file runs only where it is trusted" if attribute else ""
        raise InputError(f"{unknown_part(role, use)}{hint}")
    try:
        factory = installed.load()
    except Exception as error:  # other people's modules may fail in any way
        raise _unloadable(role, use, installed.value, error) from error
    if not callable(factory):
        raise InputError(f"{role} {use!r}: {installed.value!r} is no function")
    return factory


def shipped_function(path: str) -> Any:
    """Return one of our own functions by ``module:name``."""
    module, _, name = path.partition(":")
    return getattr(import_module(module), name)


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


def _function(role: Role, use: str, module: ModuleType, attribute: str) -> Any:
    factory = getattr(module, attribute, None)
    if not callable(factory):
        raise InputError(f"{role} {use!r}: {module.__file__} has no function {attribute!r}")
    return factory


def _beside(role: Role, part: PartBeside) -> ModuleType:
    """Return a module beside a protocol file, run once for each content in a process."""
    try:
        digest = code_digest(part.module)
    except OSError as error:
        raise _unloadable(role, part.use, str(part.module), error) from error
    if digest != part.digest:
        raise InputError(
            f"{role} {part.use!r}: {part.module} is not what it was when it was trusted; "
            "the same command again says what to do"
        )
    key = part.module, digest
    if key not in _LOADED:
        try:
            _LOADED[key] = _run_module(part.module)
        except (Exception, SystemExit) as error:  # other people's modules may fail in any way
            raise _unloadable(role, part.use, str(part.module), error) from error
    return _LOADED[key]


def _run_module(path: Path) -> ModuleType:
    """Run a module's file, under its own name unless another module has it."""
    known = sys.modules.get(path.stem)
    ours = known is None or known in _LOADED.values()
    name = path.stem if ours and path.stem not in sys.stdlib_module_names else f"beside_{path.stem}"
    spec = spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is no Python module")
    module = module_from_spec(spec)
    if str(path.parent) not in sys.path:
        sys.path.append(str(path.parent))  # last: a file there cannot hide what is installed
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def _unloadable(role: str, use: str, what: str, error: BaseException) -> InputError:
    reason = f"{type(error).__name__}: {error}".partition("\n")[0]
    return InputError(f"{role} {use!r}: cannot import {what} ({reason})")
