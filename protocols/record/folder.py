"""A study directory, opened for a run: it holds this study, or nothing."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from protocols.files.errors import InputError
from protocols.record.atomic import is_partial, remove_partials, write_whole
from protocols.record.codebook import CODEBOOK_FILE, codebook_json
from protocols.record.header import (
    STUDY_FILE,
    Origin,
    StudyHeader,
    header_of,
    read_header,
    write_header,
)
from protocols.record.identity import differences, study_digest
from protocols.record.logs import LOGS
from protocols.record.sessions import SESSIONS, read_manifest, session_folders
from protocols.resolved import ResolvedStudy

REPORT = "report"
"""Folder of a study directory with its report: not part of the record."""

_LOCK = ".lock"
_COMMAND: dict[Origin, str] = {"simulated": "run"}
_SHOWN = 5
"""How many differences between two studies are shown."""


def open_folder(
    folder: Path, study: ResolvedStudy, seed: int, origin: Origin = "simulated"
) -> StudyHeader:
    """Make a study directory, or check that one is this study's and tidy it up.

    Sessions that are there stay. A study can be enlarged; asking for fewer participants than are
    planned there changes nothing. No other process may write into the folder then (``locked``).

    Parameters
    ----------
    folder
        Where; made when it does not exist.
    study
        The study that is to be run there.
    seed
        Its seed.
    origin
        Whether synthetic or living people take part.

    Returns
    -------
    StudyHeader
        The head of the study directory, as it is now.

    Raises
    ------
    InputError
        When the folder holds something else, or another study (shows the difference), or cannot
        be made; nothing in it is touched then.
    """
    header = refuse_another_study(folder, study, seed, origin)
    make_folder(folder)
    if header is None:
        header = header_of(study, seed, origin)
        write_header(folder, header)  # first: a folder with anything else in it is refused
    for part in (SESSIONS, LOGS):
        (folder / part).mkdir(exist_ok=True)
    for place in (folder, folder / SESSIONS, folder / LOGS):
        remove_partials(place)
    header = _enlarged(folder, header, study)
    write_whole(folder / CODEBOOK_FILE, codebook_json().encode())
    return header


def refuse_another_study(
    folder: Path, study: ResolvedStudy, seed: int, origin: Origin = "simulated"
) -> StudyHeader | None:
    """Refuse a folder in which this study could not be run; write nothing.

    Returns
    -------
    StudyHeader or None
        The head of the study directory; None when there is no study in it yet.

    Raises
    ------
    InputError
        When the folder holds something else, or another study (shows the difference).
    """
    if not (folder / STUDY_FILE).exists():
        if not _sessions_are_of(folder, study_digest(study, seed)):
            _refuse_other_things(folder)
        return None
    try:
        header = read_header(folder)
    except InputError as fault:
        if not _sessions_are_of(folder, study_digest(study, seed)):
            raise
        raise InputError(
            f"{fault}; the sessions are this study's: remove {folder / STUDY_FILE}, and the same "
            "`lad-study run` writes it again"
        ) from None
    if header.origin != origin:
        raise InputError(
            f"{folder}: holds a study with origin {header.origin}, not {origin}; "
            f"allowed: another folder, or `lad-study {_COMMAND.get(header.origin, 'report')}`"
        )
    found = differences(header.study, header.seed, study, seed)
    if found:
        rest = len(found) - _SHOWN
        more = f" (and {rest} more differences)" if rest > 0 else ""
        raise InputError(
            f"{folder}: holds another study: {'; '.join(found[:_SHOWN])}{more}; "
            "allowed: the same protocol, course and seed, or another folder"
        )
    return header


def make_folder(folder: Path) -> None:
    """Make a folder, unless it is there.

    Raises
    ------
    InputError
        When it cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder}: cannot be made: {error.strerror}") from None


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Lock a study directory, made when it does not exist, until this run ends or dies.

    Every writer locks it first: of two runs that start at the same moment, the second one must not
    write a byte.

    Raises
    ------
    InputError
        When another process has locked it, it cannot be made or written, or its file system has no
        locks.
    """
    make_folder(folder)
    try:
        import fcntl  # noqa: PLC0415  # POSIX only; on other systems there is no lock
    except ImportError:  # pragma: no cover - not on POSIX
        yield
        return
    with _lock_file(folder).open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(f"{folder}: another run is writing into it; wait for it") from None
        except OSError as error:
            raise InputError(
                f"{folder}: cannot be locked against a second run ({error.strerror}); "
                "allowed: a folder on a file system with locks"
            ) from None
        yield


def lock_taken_at(folder: Path) -> float | None:
    """Return when the run that is writing into a study directory began, s since 1970.

    None when no process has locked it, or the system has no locks that tell.
    """
    path = folder / _LOCK
    try:
        import fcntl  # noqa: PLC0415  # POSIX only
    except ImportError:  # pragma: no cover - not on POSIX
        return None
    try:
        with path.open() as lock:
            begun = path.stat().st_mtime
            # A shared lock: several may look at the same time, and a run that begins at this very
            # moment is told that another is there, as it would be by a second run.
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return begun
    except OSError:
        return None
    return None


def _lock_file(folder: Path) -> Path:
    path = folder / _LOCK
    try:
        path.touch()
    except OSError as error:
        raise InputError(f"{folder}: cannot be written: {error.strerror}") from None
    return path


def _sessions_are_of(folder: Path, digest: str) -> bool:
    """Return whether there are sessions, all of the study with this digest."""
    manifests = [read_manifest(session) for session in session_folders(folder)]
    return bool(manifests) and all(m is not None and m.study == digest for m in manifests)


def _refuse_other_things(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file; allowed: a new folder, or this study's")
    if not folder.exists():
        return
    strangers = sorted(p.name for p in folder.iterdir() if p.name != _LOCK and not is_partial(p))
    if strangers:
        raise InputError(
            f"{folder}: holds something else ({strangers[0]}); "
            "allowed: a new or empty folder, or this study's"
        )


def _enlarged(folder: Path, header: StudyHeader, study: ResolvedStudy) -> StudyHeader:
    if study.protocol.cohort.participants <= header.protocol.cohort.participants:
        return header
    header = header.model_copy(update={"protocol": study.protocol})
    write_header(folder, header)
    return header
