"""A registration: a study's plan, frozen before its first session, with a digest over all of it."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from protocols.files.document import parse
from protocols.files.dump import to_yaml
from protocols.files.errors import InputError
from protocols.files.file_model import FileModel
from protocols.files.validation import validate
from protocols.model_choice import Sha256
from protocols.record.atomic import write_whole
from protocols.record.identity import identity
from protocols.registration_text import registration_text
from protocols.resolved import ResolvedStudy
from protocols.study import StudyProtocol
from protocols.versions import package_versions

REGISTRATION = "registration"
"""Folder of a study directory that holds the registration it follows."""

HEAD_FILE, PLAN_FILE, PROTOCOL_FILE = "registration.yaml", "plan.json", "protocol.yaml"
TEXT_FILE, AMENDMENTS = "registration.md", "amendments"


class Head(FileModel):
    """What ``registration.yaml`` says.

    Attributes
    ----------
    digest
        SHA-256 of ``plan.json``: of protocol, course, questionnaires, number of participants and
        versions.
    date
        When the plan was frozen, UTC.
    protocol_sha256
        SHA-256 of ``protocol.yaml``, the plan in the form in which a person reads it.
    amends
        Digest of the plan that this one replaces; None for the first.
    reason
        Why it was amended; "" for the first.
    """

    schema_version: Annotated[Literal[1], Field(alias="schema")] = 1
    digest: Sha256
    date: str
    protocol_sha256: Sha256
    amends: Sha256 | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Registration:
    """A registration as it was read, its bytes verified.

    Attributes
    ----------
    folder
        Where it lies.
    heads
        The first plan's head, then each amendment's, in order.
    plans
        The content of each.
    protocols
        The protocol of each.
    """

    folder: Path
    heads: tuple[Head, ...]
    plans: tuple[Mapping[str, Any], ...]
    protocols: tuple[StudyProtocol, ...]

    @property
    def plan(self) -> Mapping[str, Any]:
        """What holds now: the last plan's content."""
        return self.plans[-1]

    @property
    def digest(self) -> str:
        """The first plan's digest: the allocation of orders and groups comes from it."""
        return self.heads[0].digest

    @property
    def participants(self) -> int:
        """With how many participants the study stops."""
        return int(self.plan["participants"])


def plan_of(study: ResolvedStudy) -> dict[str, Any]:
    """Return everything that a registration freezes, as plain data.

    Parameters
    ----------
    study
        The study as it is going to be run.

    Examples
    --------
    >>> from protocols.load import resolve_study
    >>> plan_of(resolve_study("four-lap"))["participants"]
    12
    """
    unregistered = study.protocol.model_copy(update={"registration": None})
    return {
        "study": identity(replace(study, protocol=unregistered), None),
        "participants": study.protocol.cohort.participants,
        "expected_dropout": study.protocol.cohort.expected_dropout,
        "versions": package_versions(),
    }


def write_registration(study: ResolvedStudy, folder: Path, reason: str = "") -> tuple[str, ...]:
    """Freeze a study's plan into a folder, or amend the plan that is there.

    Parameters
    ----------
    study
        The study as it is going to be run.
    folder
        Made when it does not exist. When it holds a registration, the plan becomes its next
        amendment.
    reason
        Why the plan is amended.

    Returns
    -------
    tuple of str
        What is still to be written by hand in ``registration.md``.

    Raises
    ------
    InputError
        When the folder holds something else, a changed registration, the same plan, or a plan
        would be amended without a reason.

    Examples
    --------
    >>> import tempfile
    >>> from protocols.load import resolve_study
    >>> study = resolve_study("four-lap")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     gaps = write_registration(study, Path(folder))
    ...     files = sorted(path.name for path in Path(folder).iterdir())
    >>> files
    ['plan.json', 'protocol.yaml', 'registration.md', 'registration.yaml']
    """
    earlier = _earlier(folder)
    content = _canonical(plan_of(study))
    digest = hashlib.sha256(content).hexdigest()
    if earlier and not reason:
        raise InputError(
            f"{folder}: holds a registration; allowed: --amend with a reason, or another folder"
        )
    if not earlier and reason:
        raise InputError(f"{folder}: holds no registration to amend; allowed: without --amend")
    if earlier and earlier.heads[-1].digest == digest:
        raise InputError(f"{folder}: this is the plan that is registered; nothing to amend")
    target = folder / AMENDMENTS / f"{len(earlier.heads):03d}" if earlier else folder
    protocol = to_yaml(study.protocol).encode()
    head = Head(
        digest=digest,
        date=datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        protocol_sha256=hashlib.sha256(protocol).hexdigest(),
        amends=earlier.heads[-1].digest if earlier else None,
        reason=reason,
    )
    text, gaps = registration_text(study, digest)
    target.mkdir(parents=True, exist_ok=True)
    write_whole(target / PLAN_FILE, content)
    write_whole(target / PROTOCOL_FILE, protocol)
    write_whole(target / TEXT_FILE, text.encode())
    # Last: a folder is a registration when its head is there.
    write_whole(target / HEAD_FILE, to_yaml(head).encode())
    return gaps


def _earlier(folder: Path) -> Registration | None:
    if not folder.exists() or not any(folder.iterdir()):
        return None
    if not (folder / HEAD_FILE).is_file():
        if {path.name for path in folder.iterdir()} <= {PLAN_FILE, PROTOCOL_FILE, TEXT_FILE}:
            return None  # a registration that was stopped while it was being written
        raise InputError(f"{folder}: holds something else; allowed: an empty or a new folder")
    return read_registration(folder)


def read_registration(folder: Path) -> Registration:
    """Return a registration, every file verified.

    Parameters
    ----------
    folder
        Where ``write_registration`` put it.

    Raises
    ------
    InputError
        When there is none, or a byte of a plan has changed since it was frozen.

    Examples
    --------
    >>> import tempfile
    >>> from protocols.load import resolve_study
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = write_registration(resolve_study("four-lap"), Path(folder))
    ...     plan = read_registration(Path(folder))
    ...     _ = Path(folder, PLAN_FILE).write_text("{}")
    ...     read_registration(Path(folder))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    protocols.files.errors.InputError: ...: changed since it was registered (its digest differs)
    >>> plan.participants, len(plan.digest)
    (12, 64)
    """
    amended = sorted((folder / AMENDMENTS).glob("[0-9][0-9][0-9]"))
    heads: list[Head] = []
    plans: list[dict[str, Any]] = []
    protocols: list[StudyProtocol] = []
    for part in (folder, *amended):
        head = _head(part)
        content = _verified(part / PLAN_FILE, head.digest)
        protocol = _verified(part / PROTOCOL_FILE, head.protocol_sha256)
        if heads and head.amends != heads[-1].digest:
            raise InputError(f"{part}: does not amend the plan before it; the chain is broken")
        heads.append(head)
        plans.append(json.loads(content))
        protocols.append(validate(parse(protocol, str(part / PROTOCOL_FILE)), StudyProtocol))
    return Registration(folder, tuple(heads), tuple(plans), tuple(protocols))


def _head(folder: Path) -> Head:
    path = folder / HEAD_FILE
    try:
        return validate(parse(path.read_bytes(), str(path)), Head)
    except OSError as error:
        raise InputError(f"{path}: no registration: {error.strerror}") from None


def _verified(path: Path, digest: str) -> bytes:
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if hashlib.sha256(content).hexdigest() != digest:
        raise InputError(f"{path}: changed since it was registered (its digest differs)")
    return content


def _canonical(plan: Mapping[str, Any]) -> bytes:
    return (json.dumps(plan, sort_keys=True, indent=1, ensure_ascii=False) + "\n").encode()
