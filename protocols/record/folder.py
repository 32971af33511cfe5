"""A study directory, opened for a run: the right study, or an empty place."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from protocols.errors import InputError
from protocols.record.atomic import is_partial, remove_partials, write_whole
from protocols.record.codebook import CODEBOOK_FILE, codebook_json
from protocols.record.header import STUDY_FILE, StudyHeader, header_of, read_header, write_header
from protocols.record.identity import differences
from protocols.record.logs import LOGS
from protocols.record.sessions import SESSIONS
from protocols.resolved import ResolvedStudy

_LOCK = ".lock"


def open_folder(folder: Path, study: ResolvedStudy, seed: int) -> None:
    """Make a study directory, or check that one is this study's and tidy it up.

    Sessions that are there stay. A study can be enlarged; asking for fewer participants than are
    planned there changes nothing.

    Parameters
    ----------
    folder
        Where; made when it does not exist.
    study
        The study that is to be run there.
    seed
        Its seed.

    Raises
    ------
    InputError
        When the folder holds something else, or another study (shows the difference), or cannot
        be written; nothing in it is touched then.
    """
    header = refuse_another_study(folder, study, seed)
    if header is None:
        header = header_of(study, seed)
        _make(folder, header)
    for part in (SESSIONS, LOGS):
        (folder / part).mkdir(exist_ok=True)
    with held(folder):
        for place in (folder, folder / SESSIONS, folder / LOGS):
            remove_partials(place)
        _enlarge(folder, header, study)
        write_whole(folder / CODEBOOK_FILE, codebook_json().encode())


def refuse_another_study(folder: Path, study: ResolvedStudy, seed: int) -> StudyHeader | None:
    """Refuse a folder in which this study could not be run; write nothing.

    Returns
    -------
    StudyHeader or None
        What the folder says about itself; None when there is no study in it yet.

    Raises
    ------
    InputError
        When the folder holds something else, or another study (shows the difference).
    """
    if not (folder / STUDY_FILE).exists():
        _refuse_other_things(folder)
        return None
    header = read_header(folder)
    found = differences(header.study, header.seed, study, seed)
    if found:
        more = f" (and {len(found) - 1} more differences)" if len(found) > 1 else ""
        raise InputError(
            f"{folder}: holds another study: {found[0]}{more}; "
            "allowed: the same protocol, course and seed, or another folder"
        )
    return header


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """Hold an opened study directory: a second run is refused until this one ends or dies.

    Raises
    ------
    InputError
        When another process holds it.
    """
    try:
        import fcntl  # noqa: PLC0415  # POSIX only; elsewhere nothing is held
    except ImportError:  # pragma: no cover - not on POSIX
        yield
        return
    with (folder / LOGS / _LOCK).open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(f"{folder}: another run is writing into it; wait for it") from None
        yield


def _refuse_other_things(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file; allowed: a new folder, or this study's")
    if not folder.exists():
        return
    strangers = sorted(p.name for p in folder.iterdir() if not is_partial(p))
    if strangers:
        raise InputError(
            f"{folder}: holds something else ({strangers[0]}); "
            "allowed: a new or empty folder, or this study's"
        )


def _enlarge(folder: Path, header: StudyHeader, study: ResolvedStudy) -> None:
    if study.protocol.cohort.participants > header.protocol.cohort.participants:
        write_header(folder, header.model_copy(update={"protocol": study.protocol}))


def _make(folder: Path, header: StudyHeader) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_header(folder, header)  # first: a folder with anything else in it is refused
    except (FileExistsError, NotADirectoryError, PermissionError) as error:
        raise InputError(f"{folder}: cannot be made: {error.strerror}") from None
