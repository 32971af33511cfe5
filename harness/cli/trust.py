"""Whether a protocol's own code may be run: a person allows it, once for each file and content."""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from platformdirs import user_state_path

from harness.cli.console import complain
from protocols.code_beside import PartBeside
from protocols.files.errors import InputError
from protocols.parts import installed_parts
from protocols.record.atomic import write_whole
from protocols.resolved import ResolvedStudy


def trusted_study(study: ResolvedStudy, *, asked: bool) -> ResolvedStudy:
    """Return a study whose own code may be run, after saying which code that is.

    Parameters
    ----------
    study
        As it is in its protocol file.
    asked
        Whether the command was given ``--trust``: the code is then trusted from now on, as it is.

    Raises
    ------
    InputError
        When the protocol names code beside it that has not been trusted as it is now.
    """
    trust_code(study.beside, installed_parts(study.protocol, study.beside), asked=asked)
    return replace(study, trusted=True)


def trust_code(
    parts: Sequence[PartBeside], installed: Mapping[str, str] | None = None, *, asked: bool
) -> None:
    """Say which code will run, and refuse what has not been trusted as it is now.

    Parameters
    ----------
    parts
        In modules of a person's own.
    installed
        Parts of installed packages: name to package.
    asked
        Whether the command was given ``--trust``.

    Raises
    ------
    InputError
        When code has not been trusted as it is now.
    """
    known = _read()
    new = [part for part in parts if part.digest not in known.get(str(part.module), ())]
    if new and not asked:
        raise InputError(*(_refusal(part) for part in new))
    named = [f"{use} of {package}" for use, package in (installed or {}).items()]
    names = [*_files(parts), *named]
    if names:
        complain(f"Runs code that is not this program's: {', '.join(names)}")
    if new:
        _write(known, new)


def _refusal(part: PartBeside) -> str:
    return (
        f"{part.place}: '{part.use}' would run the code in {part.module}, which may do on this "
        "machine whatever you may; read it, and allow it with --trust"
    )


def _files(parts: Iterable[PartBeside]) -> list[str]:
    return list(dict.fromkeys(str(part.module) for part in parts))


def _record() -> Path:
    return user_state_path("lad-study", appauthor=False) / "trusted.json"


def _read() -> dict[str, list[str]]:
    """Return what has been trusted: digests by file. What cannot be read trusts nothing."""
    try:
        known = json.loads(_record().read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    if not isinstance(known, dict):
        return {}
    return {str(file): list(map(str, d)) for file, d in known.items() if isinstance(d, list)}


def _write(known: Mapping[str, list[str]], new: Iterable[PartBeside]) -> None:
    record = dict(known)
    for part in new:
        record[str(part.module)] = sorted({*record.get(str(part.module), ()), part.digest})
    try:
        _record().parent.mkdir(parents=True, exist_ok=True)
        write_whole(_record(), json.dumps(record, indent=1, sort_keys=True).encode())
    except OSError as error:
        complain(f"{_record()}: cannot be written ({error.strerror}): trusted for this run only")
