"""One participant's whole visit, in memory, and as the bytes of its files."""

import io
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from protocols.record.rows import LapRow, ParticipantRow, SurveyRow
from protocols.record.tables import LAP_SCHEMA, PARTICIPANT_SCHEMA, SURVEY_SCHEMA

PARTICIPANT_FILE = "participant_row.parquet"
LAPS_FILE = "lap_rows.parquet"
SURVEYS_FILE = "survey_rows.parquet"
MODEL_FILE = "model.npz"


def steps_file(lap: int) -> str:
    """Return the name of a lap's step table.

    Examples
    --------
    >>> steps_file(3)
    'steps-3.parquet'
    """
    return f"steps-{lap}.parquet"


@dataclass(frozen=True, slots=True)
class RecordedLap:
    """A lap's row and its steps (a table of ``STEP_SCHEMA``)."""

    row: LapRow
    steps: pa.Table


@dataclass(frozen=True, slots=True)
class SessionRecord:
    """One participant's whole visit.

    Attributes
    ----------
    participant
        The participant's row.
    laps
        The laps begun, in order.
    answers
        One row per question asked, in order.
    model
        The learned model as saved (npz bytes); None when nothing was learnt.
    """

    participant: ParticipantRow
    laps: tuple[RecordedLap, ...]
    answers: tuple[SurveyRow, ...] = ()
    model: bytes | None = None


def encode(session: SessionRecord) -> dict[str, bytes]:
    """Return the session's files: name to content. The same session gives the same bytes."""
    files = {
        PARTICIPANT_FILE: parquet_bytes(_rows([session.participant], PARTICIPANT_SCHEMA)),
        LAPS_FILE: parquet_bytes(_rows([lap.row for lap in session.laps], LAP_SCHEMA)),
        SURVEYS_FILE: parquet_bytes(_rows(session.answers, SURVEY_SCHEMA)),
    }
    for lap in session.laps:
        files[steps_file(lap.row.lap)] = parquet_bytes(lap.steps)
    if session.model is not None:
        files[MODEL_FILE] = session.model
    return files


def parquet_bytes(table: pa.Table) -> bytes:
    """Return a table as Parquet, with settings that leave nothing to chance."""
    sink = io.BytesIO()
    pq.write_table(table, sink, **PARQUET_SETTINGS)
    return sink.getvalue()


PARQUET_SETTINGS: dict[str, Any] = {
    "compression": "zstd",
    "compression_level": 3,
    "version": "2.6",
    "data_page_version": "1.0",
    "store_schema": True,
}


def _rows(rows: Sequence[Any], schema: pa.Schema) -> pa.Table:
    values = [asdict(row) for row in rows]
    for value in values:
        if "traits" in value:
            value["traits"] = sorted(value["traits"].items())
    return pa.Table.from_pylist(values, schema=schema)
