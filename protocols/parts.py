"""Where the parts that a protocol names come from. Nothing here runs a part's code."""

from collections.abc import Iterable, Iterator
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import NamedTuple

from protocols.code_beside import PartBeside, code_digest, module_beside
from protocols.files.document import Document, spoken
from protocols.files.fault import Fault, Location
from protocols.files.suggestion import allowed
from protocols.shipped_parts import SHIPPED, Role, shipped_factory
from protocols.study import StudyProtocol

ENTRY_POINTS = "lad_study.parts"
"""The group in which an installed package declares its parts."""

OWN_PARTS = (
    "a part of an installed package",
    "module:factory of a module beside the protocol file",
)
"""What may be named besides the parts that ship."""


class NamedPart(NamedTuple):
    """A part that a protocol names, and the field that does."""

    where: Location
    role: Role
    use: str


def named_parts(protocol: StudyProtocol) -> Iterator[NamedPart]:
    """Yield every part that a protocol names, in the order of the format."""
    cohort = protocol.cohort
    roles: tuple[Role, ...] = ("driver", "demonstrator", "respondent")
    for role in roles:
        choice = getattr(cohort, role)
        if choice is not None:
            yield NamedPart(("cohort", role, "use"), role, choice.use)
    for i, impairment in enumerate(cohort.impairments):
        yield NamedPart(("cohort", "impairments", i, "use"), "impairment", impairment.use)
    yield NamedPart(("model", "use"), "model", protocol.model.use)
    for name, further in protocol.demonstrators.items():
        yield NamedPart(("demonstrators", name, "use"), "demonstrator", further.use)
    for name, group in protocol.groups.items():
        if group.model is not None:
            yield NamedPart(("groups", name, "model", "use"), "model", group.model.use)
        if group.demonstrator is not None:
            yield NamedPart(
                ("groups", name, "demonstrator", "use"), "demonstrator", group.demonstrator.use
            )


def installed_part(use: str) -> EntryPoint | None:
    """Return what an installed package declares under a name; None when none does.

    Two packages may declare the same name: the first by the name of the package is taken, on every
    machine with these packages the same one.
    """
    found = sorted(
        entry_points(group=ENTRY_POINTS, name=use), key=lambda e: e.dist.name if e.dist else ""
    )
    return found[0] if found else None


def parts_beside(
    protocol: StudyProtocol, folder: Path | None, document: Document | None = None
) -> tuple[PartBeside, ...]:
    """Return the parts that a protocol takes from modules beside its file.

    Parameters
    ----------
    protocol
        The protocol.
    folder
        Its file's; None for a shipped one, which has nothing beside it.
    document
        The file, for the places; None for none.

    Raises
    ------
    InputError
        When ``document`` names a part that is neither shipped, nor installed, nor there.
    """
    beside, faults = [], []
    for part in named_parts(protocol):
        if shipped_factory(part.role, part.use):
            continue
        module = None if folder is None else module_beside(folder, part.use)
        if module is not None:
            at = spoken(part.where)
            place = f"{document.source}:{document.line(part.where)}: {at}" if document else at
            beside.append(PartBeside(place, part.use, module, code_digest(module)))
        elif installed_part(part.use) is None:
            faults.append(Fault(part.where, unknown_part(part.role, part.use)))
    if faults and document is not None:
        raise document.error(faults)
    return tuple(beside)


def models_beside(names: Iterable[str], folder: Path) -> tuple[PartBeside, ...]:
    """Return the models among names that are in modules of a folder.

    Parameters
    ----------
    names
        As a command line has them.
    folder
        Where the modules are.
    """
    found = ((name, module_beside(folder, name)) for name in dict.fromkeys(names))
    return tuple(
        PartBeside("MODEL", name, module, code_digest(module))
        for name, module in found
        if module is not None and not shipped_factory("model", name)
    )


def installed_parts(protocol: StudyProtocol, beside: tuple[PartBeside, ...]) -> dict[str, str]:
    """Return the parts that a protocol takes from installed packages: name to package."""
    here, found = {part.use for part in beside}, {}
    for part in named_parts(protocol):
        if part.use in here or shipped_factory(part.role, part.use):
            continue
        entry = installed_part(part.use)
        if entry is not None:
            found[part.use] = entry.dist.name if entry.dist else entry.value
    return found


def unknown_part(role: Role, use: str) -> str:
    """Return a message's text: no part is called so, and what is allowed."""
    return f"no {role} is called '{use}'; {allowed(use, SHIPPED[role], OWN_PARTS)}"
