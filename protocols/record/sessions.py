"""Session folders: each appears whole or not at all."""

import itertools
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

from protocols.record.atomic import is_partial, partial_beside, sync_folder, write_through
from protocols.record.manifest import MANIFEST_FILE, Manifest, entry, parse_manifest
from protocols.record.rows import participant_id
from protocols.record.session import MODEL_FILE

SESSIONS = "sessions"


SET_ASIDE = "set-aside"
"""Folder of a study directory for sessions that cannot be used but must not be deleted."""


def write_session(
    folder: Path, participant: str, files: Mapping[str, bytes], *, keep_damaged: bool = False
) -> None:
    """Add a session to a study directory: written beside its place, then renamed.

    A whole session that is already there stays as it is; a damaged one is replaced, and one of
    another study.

    Parameters
    ----------
    folder
        The study directory.
    participant
        The participant's id, the session folder's name.
    files
        As ``protocols.record.session.encode`` returns them, manifest included.
    keep_damaged
        Whether a session that is replaced is moved to ``SET_ASIDE``, as a living person's must
        be; a simulated one can be rebuilt and is deleted.

    Raises
    ------
    OSError
        When it cannot be written; there is no such session then.
    ValueError
        When the files do not match their manifest.
    """
    target = folder / SESSIONS / participant
    manifest = _checked(participant, files)
    if is_whole(target, manifest.study) and not (keep_damaged and any(session_faults(target))):
        return
    partial = partial_beside(target)
    shutil.rmtree(partial, ignore_errors=True)
    try:
        partial.mkdir(parents=True)
        for name in sorted(files):
            write_through(partial / name, files[name])
        sync_folder(partial)
        if keep_damaged:
            set_aside(folder, participant)
        else:
            _delete(target)
        partial.rename(target)
    except BaseException:
        shutil.rmtree(partial, ignore_errors=True)
        raise
    sync_folder(target.parent)


def _checked(participant: str, files: Mapping[str, bytes]) -> Manifest:
    manifest = parse_manifest(files.get(MANIFEST_FILE, b""))
    contents = {name: entry(files[name]) for name in files if name != MANIFEST_FILE}
    if manifest is None or manifest.files != contents:
        raise ValueError(f"session {participant}: the files do not match their manifest")
    return manifest


def set_aside(folder: Path, participant: str) -> Path | None:
    """Move a session's folder to ``SET_ASIDE``; return its new path, None if there is none."""
    source = folder / SESSIONS / participant
    if not source.exists():
        return None
    parent = folder / SET_ASIDE
    parent.mkdir(exist_ok=True)
    taken = {path.name for path in parent.iterdir()}
    number = next(n for n in itertools.count(1) if f"{participant}-{n}" not in taken)
    target = parent / f"{participant}-{number}"
    source.rename(target)
    sync_folder(parent)
    sync_folder(source.parent)
    return target


def _delete(target: Path) -> None:
    """Delete a damaged session; rename it first, so that a killed run never leaves half of it."""
    if target.exists():
        aside = partial_beside(target.with_name(f"damaged-{target.name}"))
        shutil.rmtree(aside, ignore_errors=True)
        target.rename(aside)
        shutil.rmtree(aside, ignore_errors=True)


def finished_sessions(folder: Path, study: str | None = None) -> tuple[str, ...]:
    """Return the participants whose sessions are whole, sorted.

    Parameters
    ----------
    folder
        The study directory.
    study
        Only sessions of the study with this digest; None for all.
    """
    return tuple(path.name for path in session_folders(folder) if is_whole(path, study))


def whole_sessions(folder: Path, study: str | None = None) -> tuple[str, ...]:
    """Return the participants whose sessions are whole, checksums compared, sorted."""
    return tuple(
        path.name
        for path in session_folders(folder)
        if is_whole(path, study) and not any(session_faults(path))
    )


def model_before(folder: Path, number: int) -> bytes | None:
    """Return the model that the nearest participant before a number has left; None for none."""
    for earlier in range(number - 1, 0, -1):
        session = folder / SESSIONS / participant_id(earlier)
        path = session / MODEL_FILE
        if path.is_file() and is_whole(session):
            return path.read_bytes()
    return None


def session_folders(folder: Path) -> tuple[Path, ...]:
    """Return every session folder of a study directory, whole or not, sorted by name."""
    parent = folder / SESSIONS
    if not parent.is_dir():
        return ()
    return tuple(sorted(p for p in parent.iterdir() if p.is_dir() and not is_partial(p)))


def is_whole(session: Path, study: str | None = None) -> bool:
    """Return whether every file of a session's manifest is there with its size.

    With a study's digest, also whether it is a session of that study, where its manifest tells.
    ``session_faults`` compares checksums too.
    """
    manifest = read_manifest(session)
    return (
        manifest is not None
        and (study is None or manifest.study in {None, study})
        and all(_size(session / name) == file.bytes for name, file in manifest.files.items())
    )


def _size(path: Path) -> int | None:
    try:
        return path.stat().st_size
    except OSError:
        return None


def read_manifest(session: Path) -> Manifest | None:
    """Return a session's manifest; None when it has none that can be read."""
    try:
        return parse_manifest((session / MANIFEST_FILE).read_bytes())
    except OSError:
        return None


def session_faults(session: Path) -> Iterator[str]:
    """Compare a session's files with its manifest, and return one line for each fault."""
    manifest = read_manifest(session)
    if manifest is None:
        yield f"{session / MANIFEST_FILE}: missing or damaged"
        return
    for name, wanted in manifest.files.items():
        path = session / name
        if not path.is_file():
            yield f"{path}: missing"
        elif entry(path.read_bytes()) != wanted:
            yield f"{path}: not what was written (its checksum differs)"
    there = {path.name for path in session.iterdir()}
    for name in sorted(there - manifest.files.keys() - {MANIFEST_FILE}):
        yield f"{session / name}: not part of the session"
