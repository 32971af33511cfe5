"""Where the part to be checked comes from: the name a protocol would give it, or its factory."""

from collections.abc import Callable, Mapping
from copy import deepcopy
from importlib import import_module
from typing import Any

from harness.part_checks.named import named_factory
from harness.part_checks.plain import plain
from harness.part_checks.role import Role
from harness.part_checks.setting import Setting


class PartSource:
    """Makes the part again and again, as a study does for each participant.

    Parameters
    ----------
    part
        A shipped name, ``module:factory``, or the factory itself.
    role
        Of the part, in one word, for messages.
    shipped
        The role's shipped names.
    options
        What a protocol would give it.

    Attributes
    ----------
    label
        How reports call the part.
    path
        The name under which another process finds the factory; None when there is none.

    Raises
    ------
    InputError
        When no factory is found under the name.
    """

    def __init__(
        self,
        part: str | Callable[..., Any],
        role: str,
        shipped: Mapping[str, str],
        options: Mapping[str, Any] | None = None,
    ) -> None:
        self.options = dict(options or {})
        self.factory = named_factory(role, shipped, part) if isinstance(part, str) else part
        self.path = part if isinstance(part, str) else _path_of(part)
        self.label = part if isinstance(part, str) else _name_of(part)
        self._given: list[dict[str, Any]] = []
        self._settings: list[tuple[Setting, str]] = []

    def make(self, role: Role, setting: Setting) -> Any:
        """Return a new part; it gets a copy of the options of its own."""
        self._given.append(deepcopy(self.options))
        self._settings.append((setting, setting.course.model_dump_json()))
        return role.make(self.factory, self._given[-1], setting)

    def written_to(self) -> str | None:
        """Return what of its options or its course a part has changed by now; None for nothing."""
        if any(plain(given) != plain(self.options) for given in self._given):
            return "its options"
        if any(setting.course.model_dump_json() != dump for setting, dump in self._settings):
            return "its course"
        return None


def _name_of(factory: Callable[..., Any]) -> str:
    module, name = getattr(factory, "__module__", ""), getattr(factory, "__qualname__", "")
    return f"{module}:{name}" if name else repr(factory)


def _path_of(factory: Callable[..., Any]) -> str | None:
    """Return ``module:factory`` if that leads to this very function."""
    module, _, name = _name_of(factory).partition(":")
    try:
        found = getattr(import_module(module), name, None)
    except Exception:  # noqa: BLE001  # a module may fail in any way when it is imported again
        return None
    return f"{module}:{name}" if found is factory else None
