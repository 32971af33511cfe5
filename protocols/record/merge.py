"""The study's tables, built from its sessions."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from protocols.files.errors import InputError
from protocols.record.atomic import naming, partial_beside, sync_folder
from protocols.record.column import Column, arrow_schema, brought_up_to_date
from protocols.record.parquet import parquet_settings, read_parquet
from protocols.record.session import LAPS_FILE, PARTICIPANT_FILE, SURVEYS_FILE
from protocols.record.sessions import SESSIONS, finished_sessions
from protocols.record.tables import LAP_COLUMNS, PARTICIPANT_COLUMNS, SURVEY_COLUMNS

PARTICIPANTS_TABLE = "participants.parquet"
LAPS_TABLE = "laps.parquet"
SURVEYS_TABLE = "surveys.parquet"

STUDY_TABLES = (
    (SURVEYS_TABLE, SURVEYS_FILE, SURVEY_COLUMNS),
    (LAPS_TABLE, LAPS_FILE, LAP_COLUMNS),
    (PARTICIPANTS_TABLE, PARTICIPANT_FILE, PARTICIPANT_COLUMNS),
)
"""Name of each table, of the file in a session that its rows come from, and its columns.

Participants come last: a participant in that table is in the others, even after a killed run.
"""

_SESSIONS_PER_ROW_GROUP = 500


def build_tables(folder: Path, study: str | None = None) -> None:
    """Build participants, laps and surveys from the whole sessions of a study directory.

    The tables depend on the sessions alone, not on the order in which they were finished, and
    never more than a few hundred sessions' rows are in memory.

    Parameters
    ----------
    folder
        The study directory.
    study
        Only from sessions of the study with this digest; None for all.

    Raises
    ------
    InputError
        When a session's file cannot be read; names it. The old tables are still there then.
    OSError
        When they cannot be written. Every old table that no new one has replaced
        is still there then.
    """
    participants = finished_sessions(folder, study)
    partials = {folder / table: partial_beside(folder / table) for table, _, _ in STUDY_TABLES}
    try:
        for table, part, columns in STUDY_TABLES:
            rows = _row_groups(folder / SESSIONS, part, columns, participants)
            _write(folder / table, partials[folder / table], arrow_schema(columns), rows)
        for target, partial in partials.items():
            partial.replace(target)
    except BaseException:
        for partial in partials.values():
            partial.unlink(missing_ok=True)
        raise
    sync_folder(folder)


def _write(target: Path, partial: Path, schema: pa.Schema, groups: Iterator[pa.Table]) -> None:
    with naming(target):
        with pq.ParquetWriter(partial, schema, **parquet_settings(schema)) as writer:
            for rows in groups:
                writer.write_table(rows)
        with partial.open("rb") as opened:
            os.fsync(opened.fileno())


def _row_groups(
    sessions: Path, part: str, columns: tuple[Column, ...], participants: Sequence[str]
) -> Iterator[pa.Table]:
    for start in range(0, len(participants), _SESSIONS_PER_ROW_GROUP):
        names = participants[start : start + _SESSIONS_PER_ROW_GROUP]
        tables = [session_rows(sessions / name / part, columns) for name in names]
        yield pa.concat_tables(tables).combine_chunks()


def session_rows(path: Path, columns: tuple[Column, ...]) -> pa.Table:
    """Return a session's table of any record version in this version's columns.

    Raises
    ------
    InputError
        When it cannot be read or has other columns.
    """
    table = brought_up_to_date(read_parquet(path), columns)
    if table is None:
        raise InputError(f"{path}: its columns are not those of the record")
    return table
