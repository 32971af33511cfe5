"""Verify a study directory: what is wrong in it, and what to do about it."""

from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa

from protocols.files.errors import InputError
from protocols.order import group_of, in_words, laps_of
from protocols.record.amendment import first_digest, plan_number
from protocols.record.codebook import CODEBOOK_FILE, codebook_json
from protocols.record.column import SCHEMA_VERSIONS, arrow_schema, brought_up_to_date
from protocols.record.elsewhere.faults import (
    Tell,
    foreign_faults,
    times_unlike_completed,
    without_steps,
)
from protocols.record.enrolment import purged, slot_of
from protocols.record.header import STUDY_FILE, StudyHeader, read_header
from protocols.record.identity import study_digest
from protocols.record.journal import journal_path
from protocols.record.logs import failures
from protocols.record.merge import STUDY_TABLES, session_rows
from protocols.record.parquet import parquet_shape, read_parquet
from protocols.record.reader import open_study
from protocols.record.resume import resume_command
from protocols.record.rows import (
    ENDS_SESSION,
    participant_id,
    questions_follow,
)
from protocols.record.session import (
    EVENTS_FILE,
    LAPS_FILE,
    MODEL_FILE,
    PARTICIPANT_FILE,
    SURVEYS_FILE,
    steps_file,
)
from protocols.record.sessions import SESSIONS, read_manifest, session_faults, session_folders
from protocols.record.steps import STEP_COLUMNS
from protocols.record.tables import LAP_COLUMNS, PARTICIPANT_COLUMNS, SURVEY_COLUMNS
from protocols.registered_study import plan_study, registration_faults
from protocols.registration import REGISTRATION, Registration, read_registration
from protocols.resolved import ResolvedStudy


def check_study(folder: Path, tell: Tell | None = None) -> tuple[str, ...]:
    """Return what is wrong with a study directory, one line each; empty when all is well.

    Every session's files are compared with their checksums and with one another, the tables with
    the sessions, the codebook with the schema, and the sessions with the protocol. Of a study
    that was recorded elsewhere, which has no checksums, every table is read.

    Parameters
    ----------
    folder
        The study directory; nothing in it is changed.
    tell
        Called with a few words about what is being read; None for no one.

    Raises
    ------
    InputError
        When the folder is no study directory at all.

    Examples
    --------
    >>> check_study(Path("nowhere"))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    protocols.files.errors.InputError: nowhere...
    """
    header = read_header(folder)
    if header.origin == "elsewhere":
        return tuple(foreign_faults(folder, tell))
    sessions = session_folders(folder)
    again = f"`{resume_command(folder, header)}`"
    faults = [
        *_header_faults(folder, header, again),
        *_missing_sessions(folder, header, sessions, again),
        *_sessions_beyond(folder, header, sessions),
        *registration_faults(folder, header.study),
    ]
    chain = _chain(folder, header)
    sound = []
    for number, session in enumerate(sessions, start=1):
        if tell is not None:
            tell(f"Session {number} of {len(sessions)}")
        found = list(_session_faults(session, header, chain))
        faults += [f"{fault}; {_mend(header, session, again)}" for fault in found]
        if not found:
            sound.append(session.name)
    # A damaged session cannot be compared with the tables: its own faults are enough.
    if len(sound) == len(sessions):
        faults += _table_faults(folder, sound, again)
    return tuple(faults)


def _mend(header: StudyHeader, session: Path, again: str) -> str:
    """Return what to do about a damaged session: only a simulated one may be deleted."""
    if header.origin == "simulated":
        return f"remove {session}, then {again} rebuilds it"
    journal = journal_path(session.parents[1], session.name)
    if journal.is_file():
        return f"`lad-study recover {session.parents[1]}` rebuilds it from {journal}"
    return "it is a living person's and has no journal: keep it, and repair it by hand"


def check_remarks(folder: Path) -> tuple[str, ...]:
    """Return what is repaired or not there in a study directory without faults, one line each.

    Parameters
    ----------
    folder
        A study directory that ``check_study`` finds nothing wrong with.
    """
    study = open_study(folder)
    return (*study.remarks, *without_steps(study), *times_unlike_completed(study))


def _header_faults(folder: Path, header: StudyHeader, again: str) -> Iterator[str]:
    chain = _chain(folder, header)
    wanted = header.digest if chain is None else first_digest(header, chain)
    if not header.amended and header.seed is not None:
        wanted = study_digest(header.study, header.seed)
    if header.digest != wanted:
        yield (
            f"{folder / STUDY_FILE}: was changed after the run (its digest differs); "
            "put the original back, or run the changed study in another folder"
        )
    path = folder / CODEBOOK_FILE
    if not path.is_file() or path.read_bytes() != codebook_json().encode():
        yield f"{path}: missing, or not this version's; {again} rebuilds it"


def _chain(folder: Path, header: StudyHeader) -> Registration | None:
    """Return the plans of an amended study; None for others, and where they cannot be read."""
    if not header.amended:
        return None
    try:
        found = read_registration(folder / REGISTRATION)
    except InputError:
        return None  # registration_faults says what is wrong
    return found if len(found.heads) > header.amended[-1].number else None


def _missing_sessions(
    folder: Path, header: StudyHeader, sessions: tuple[Path, ...], again: str
) -> Iterator[str]:
    if header.origin == "live":
        yield from _missing_people(folder, header, sessions, again)
        return
    there = {session.name for session in sessions}
    planned = map(participant_id, range(1, header.protocol.cohort.participants + 1))
    absent = [name for name in planned if name not in there]
    gave_up = set(failures(folder))
    failed = [name for name in absent if name in gave_up]
    missing = [name for name in absent if name not in gave_up]
    of = f"of {header.protocol.cohort.participants} sessions"
    if missing:
        yield (f"{len(missing)} {of} are missing ({missing[0]} first); {again} adds them")
    if failed:
        yield (
            f"{len(failed)} {of} failed ({failed[0]} first; see {folder / 'logs'}); "
            f"{again} with --retry-failed runs them again"
        )


def _missing_people(
    folder: Path, header: StudyHeader, sessions: tuple[Path, ...], again: str
) -> Iterator[str]:
    """Tell how many living people are still to come; whoever left has taken part."""
    wanted = header.protocol.cohort.participants
    missing = wanted - len({session.name for session in sessions} | purged(folder))
    if missing > 0:
        yield f"{missing} of {wanted} sessions are missing; {again} adds them"


def _sessions_beyond(
    folder: Path, header: StudyHeader, sessions: tuple[Path, ...]
) -> Iterator[str]:
    if header.origin == "live":  # people who left are replaced, by others with other numbers
        return
    count = header.protocol.cohort.participants
    planned = set(map(participant_id, range(1, count + 1)))
    beyond = [session.name for session in sessions if session.name not in planned]
    if beyond:
        yield (
            f"{folder / SESSIONS}: {len(beyond)} sessions beyond the {count} participants planned "
            f"({beyond[0]} first); `lad-study run` with more --participants takes them in"
        )


def _session_faults(
    session: Path, header: StudyHeader, chain: Registration | None
) -> Iterator[str]:
    """Check the files of one session: first their bytes, then their contents."""
    damaged = list(session_faults(session))
    yield from damaged
    if damaged:
        return
    manifest = read_manifest(session)
    if manifest and header.digest and manifest.study not in {None, header.digest}:
        yield f"{session}: a session of another study (its study's digest differs)"
        return
    try:
        study = header.study
        if chain is not None:
            study = plan_study(chain, plan_number(header, session.name))
        yield from _content_faults(session, study, header.seed or 0)
    except InputError as error:
        yield str(error)


def _content_faults(session: Path, study: ResolvedStudy, seed: int) -> Iterator[str]:
    participant = session_rows(session / PARTICIPANT_FILE, PARTICIPANT_COLUMNS)
    laps = session_rows(session / LAPS_FILE, LAP_COLUMNS)
    surveys = session_rows(session / SURVEYS_FILE, SURVEY_COLUMNS)
    for table in (participant, laps, surveys):
        strangers = set(table["participant"].to_pylist()) - {session.name}
        if strangers:
            yield f"{session}: rows of {strangers.pop()} in the session of {session.name}"
    driven = participant["laps_driven"].to_pylist()
    if driven != [laps.num_rows]:
        yield f"{session / LAPS_FILE}: {laps.num_rows} laps; the participant's row has {driven}"
    yield from _allocation_faults(session, participant, study, seed)
    yield from _lap_faults(session, laps)
    yield from _survey_faults(session, laps, surveys, study, seed)


def _allocation_faults(
    session: Path, participant: pa.Table, study: ResolvedStudy, seed: int
) -> Iterator[str]:
    """Compare order and group with those the protocol gives; a record of before has neither."""
    slot = slot_of(session.parents[1], session.name)
    given = in_words(laps_of(study.protocol, slot, seed)), group_of(study.protocol, slot, seed)
    for row in participant.select(["order", "group"]).to_pylist():
        if row["order"] is not None and (row["order"], row["group"]) != given:
            yield f"{session / PARTICIPANT_FILE}: another order or group than the protocol gives"


def _lap_faults(session: Path, laps: pa.Table) -> Iterator[str]:
    """Compare the laps' rows with the files there are, and with their numbers of steps."""
    numbers = laps["lap"].to_pylist()
    wanted = {PARTICIPANT_FILE, LAPS_FILE, SURVEYS_FILE, *map(steps_file, numbers)}
    manifest = read_manifest(session)
    listed = set(manifest.files) - {MODEL_FILE, EVENTS_FILE} if manifest else set()
    for name in sorted(wanted ^ listed):
        yield f"{session / name}: {'missing' if name in wanted else 'of a lap without a row'}"
    for lap, steps in zip(numbers, laps["steps"].to_pylist(), strict=True):
        path = session / steps_file(lap)
        if path.name not in listed:
            continue
        schema, recorded = parquet_shape(path)
        if not any(schema.equals(arrow_schema(STEP_COLUMNS, v)) for v in SCHEMA_VERSIONS):
            yield f"{path}: its columns are not those of the record"
        if recorded != steps:
            yield f"{path}: {recorded} steps; the lap's row has {steps}"


def _survey_faults(
    session: Path, laps: pa.Table, surveys: pa.Table, study: ResolvedStudy, seed: int
) -> Iterator[str]:
    """Compare the answers' rows with the questions the protocol asks after each lap."""
    there = list(zip(*(surveys[c].to_pylist() for c in ("lap", "instrument", "item")), strict=True))
    slot = slot_of(session.parents[1], session.name)
    planned = dict(enumerate(laps_of(study.protocol, slot, seed)))
    by_condition = {lap.condition: lap for lap in planned.values()}
    conditions = dict(zip(laps["lap"].to_pylist(), laps["condition"].to_pylist(), strict=True))
    for number in set(conditions) - set(planned):  # driven once more
        if conditions[number] in by_condition:
            planned[number] = by_condition[conditions[number]]
    wanted = [
        (row["lap"], instrument.name, item.id)
        for row in laps.select(["lap", "end_reason"]).to_pylist()
        if questions_follow(row["end_reason"]) and row["lap"] in planned
        for instrument, item in study.questions(planned[row["lap"]])
    ]
    over = all(reason not in ENDS_SESSION for reason in laps["end_reason"].to_pylist())
    if over and laps.num_rows == len(planned):
        wanted += [(-1, i.name, item.id) for i, item in study.session_questions]
    if there != wanted:
        yield (
            f"{session / SURVEYS_FILE}: {len(there)} answers; the protocol asks {len(wanted)} "
            "questions in the laps that were driven"
        )


def _table_faults(folder: Path, participants: list[str], again: str) -> Iterator[str]:
    for name, part, columns in STUDY_TABLES:
        path = folder / name
        rows = [session_rows(folder / SESSIONS / p / part, columns) for p in participants]
        wanted = pa.concat_tables(rows) if rows else arrow_schema(columns).empty_table()
        try:
            there = brought_up_to_date(read_parquet(path), columns)
            same = there is not None and there.equals(wanted)
        except InputError as error:
            yield f"{error}; {again} rebuilds it"
            continue
        if not same:
            yield f"{path}: does not hold the rows of the sessions; {again} rebuilds it"
