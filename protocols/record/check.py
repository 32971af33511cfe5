"""Verify a study directory: what is wrong in it, and what to do about it."""

from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa

from protocols.errors import InputError
from protocols.record.codebook import CODEBOOK_FILE, codebook_json
from protocols.record.header import STUDY_FILE, StudyHeader, read_header
from protocols.record.identity import study_digest
from protocols.record.merge import STUDY_TABLES, session_rows
from protocols.record.parquet import read_parquet
from protocols.record.rows import participant_id
from protocols.record.session import LAPS_FILE, PARTICIPANT_FILE, SURVEYS_FILE, steps_file
from protocols.record.sessions import SESSIONS, session_faults, session_folders
from protocols.record.steps import STEP_SCHEMA
from protocols.record.tables import LAP_SCHEMA, PARTICIPANT_SCHEMA, SURVEY_SCHEMA

_AGAIN = "the same `lad-study run` again makes it anew"


def check_study(folder: Path) -> tuple[str, ...]:
    """Return what is wrong with a study directory, one line each; empty when all is well.

    Every session's files are compared with their checksums and with one another, the tables with
    the sessions, the codebook with the schema, and the sessions with the plan.

    Raises
    ------
    InputError
        When the folder is no study directory at all.
    """
    header = read_header(folder)
    sessions = session_folders(folder)
    faults = [*_header_faults(folder, header), *_missing_sessions(header, sessions)]
    sound = []
    for session in sessions:
        found = list(_session_faults(session))
        faults += [f"{fault}; remove {session}, then {_AGAIN}" for fault in found]
        if not found:
            sound.append(session.name)
    # A damaged session cannot be compared with the tables: its own faults say enough.
    if len(sound) == len(sessions):
        faults += _table_faults(folder, sound)
    return tuple(faults)


def _header_faults(folder: Path, header: StudyHeader) -> Iterator[str]:
    if header.seed is not None and header.digest != study_digest(header.study, header.seed):
        yield (
            f"{folder / STUDY_FILE}: was changed after the run (its digest differs); "
            "put the original back, or run the changed study in another folder"
        )
    path = folder / CODEBOOK_FILE
    if not path.is_file() or path.read_bytes() != codebook_json().encode():
        yield f"{path}: missing, or not this version's; {_AGAIN}"


def _missing_sessions(header: StudyHeader, sessions: tuple[Path, ...]) -> Iterator[str]:
    there = {session.name for session in sessions}
    planned = map(participant_id, range(1, header.protocol.cohort.participants + 1))
    missing = [name for name in planned if name not in there]
    if header.seed is not None and missing:
        yield (
            f"{len(missing)} of {header.protocol.cohort.participants} sessions are missing "
            f"({missing[0]} first); the same `lad-study run` again adds them"
        )


def _session_faults(session: Path) -> Iterator[str]:
    """Check the files of one session: bytes first, then what they say."""
    damaged = list(session_faults(session))
    yield from damaged
    if damaged:
        return
    try:
        yield from _content_faults(session)
    except InputError as error:
        yield str(error)


def _content_faults(session: Path) -> Iterator[str]:
    participant = session_rows(session / PARTICIPANT_FILE, PARTICIPANT_SCHEMA)
    laps = session_rows(session / LAPS_FILE, LAP_SCHEMA)
    surveys = session_rows(session / SURVEYS_FILE, SURVEY_SCHEMA)
    for table in (participant, laps, surveys):
        strangers = set(table["participant"].to_pylist()) - {session.name}
        if strangers:
            yield f"{session}: rows of {strangers.pop()} in the session of {session.name}"
    driven = participant["laps_driven"].to_pylist()
    if driven != [laps.num_rows]:
        yield f"{session / LAPS_FILE}: {laps.num_rows} laps; the participant's row says {driven}"
    for lap, steps in zip(laps["lap"].to_pylist(), laps["steps"].to_pylist(), strict=True):
        path = session / steps_file(lap)
        recorded = session_rows(path, STEP_SCHEMA).num_rows
        if recorded != steps:
            yield f"{path}: {recorded} steps; the lap's row says {steps}"


def _table_faults(folder: Path, participants: list[str]) -> Iterator[str]:
    for name, part, schema in STUDY_TABLES:
        path = folder / name
        rows = [session_rows(folder / SESSIONS / p / part, schema) for p in participants]
        wanted = pa.concat_tables(rows) if rows else schema.empty_table()
        try:
            same = read_parquet(path).equals(wanted)
        except InputError as error:
            yield f"{error}; {_AGAIN}"
            continue
        if not same:
            yield f"{path}: does not hold the rows of the sessions; {_AGAIN}"
