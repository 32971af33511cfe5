"""Which role a part is for, where none is given: from its name, or from what its factory makes."""

import contextlib
from collections.abc import Mapping
from typing import Any, get_args

from harness.part_checks.interface import missing
from harness.part_checks.role import ROLES, Role, RoleName
from harness.part_checks.setting import Setting
from harness.part_checks.source import PartSource
from harness.part_checks.world import METHODS, make_world
from protocols.files.errors import InputError

ROLE_NAMES: tuple[RoleName, ...] = get_args(RoleName)

TRIED: tuple[RoleName, ...] = ("driver", "impairment", "demonstrator", "respondent", "assistant")
"""In this order: what drives without a driver to be put around is no impairment, and what has
``look`` is a demonstrator."""


def guess_role(part: str, options: Mapping[str, Any], setting: Setting) -> RoleName:
    """Return the role of a part.

    A shipped name has one. Another factory is called as each role's would be, until it makes
    something that has the role's methods.

    Raises
    ------
    InputError
        When there is no such part, or it fits no role: then the role must be given.

    Examples
    --------
    >>> guess_role("tremor", {}, Setting())
    'impairment'
    """
    shipped = {name: role for role in ROLES.values() for name in role.shipped}
    if part in shipped:
        return shipped[part].name
    every = {name: path for role in ROLES.values() for name, path in role.shipped.items()}
    source = PartSource(part, "part", every, options)
    refusals: list[InputError] = []
    for name in TRIED:
        if _fits(ROLES[name], source, setting, refusals):
            return name
    if _is_world(source, setting):
        return "world"
    if refusals:
        raise refusals[0]
    raise InputError(
        f"part {part!r}: what it makes does not show its role; give --role {'|'.join(ROLE_NAMES)}"
    )


def _fits(role: Role, source: PartSource, setting: Setting, refusals: list[InputError]) -> bool:
    """Return whether a factory makes a part of a role; its message about options is kept."""
    try:
        part = source.make(role, setting)
    except InputError as refusal:
        refusals.append(refusal)
        return False
    except (Exception, SystemExit):  # noqa: BLE001  # not this role's factory
        return False
    return missing(part, role.signatures) is None


def _is_world(source: PartSource, setting: Setting) -> bool:
    with contextlib.suppress(Exception, SystemExit):
        world = make_world(source, setting)
        fits = missing(world, METHODS) is None
        close = getattr(world, "close", None)
        if fits and callable(close):
            close()
        return fits
    return False
