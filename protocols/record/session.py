"""One participant's whole session, in memory, and as the bytes of its files."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import pyarrow as pa

from protocols.record.manifest import MANIFEST_FILE, manifest_of
from protocols.record.parquet import parquet_bytes
from protocols.record.rows import EventRow, LapRow, ParticipantRow, SurveyRow
from protocols.record.tables import EVENT_SCHEMA, LAP_SCHEMA, PARTICIPANT_SCHEMA, SURVEY_SCHEMA

PARTICIPANT_FILE = "participant_row.parquet"
LAPS_FILE = "lap_rows.parquet"
SURVEYS_FILE = "survey_rows.parquet"
MODEL_FILE = "model.npz"
EVENTS_FILE = "event_rows.parquet"


def steps_file(lap: int | str) -> str:
    """Return the name of a lap's step table; of every lap's for ``"*"``.

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
    """One participant's whole session.

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
    events
        What else happened; empty for a simulated session.
    """

    participant: ParticipantRow
    laps: tuple[RecordedLap, ...]
    answers: tuple[SurveyRow, ...] = ()
    model: bytes | None = None
    events: tuple[EventRow, ...] = ()


def encode(session: SessionRecord, study: str | None = None) -> dict[str, bytes]:
    """Return the session's files: name to content.

    The same session gives the same bytes; the manifest also names the software in use, and the
    study it belongs to, by its digest.
    """
    files = {
        PARTICIPANT_FILE: parquet_bytes(_rows([session.participant], PARTICIPANT_SCHEMA)),
        LAPS_FILE: parquet_bytes(_rows([lap.row for lap in session.laps], LAP_SCHEMA)),
        SURVEYS_FILE: parquet_bytes(_rows(session.answers, SURVEY_SCHEMA)),
    }
    for lap in session.laps:
        files[steps_file(lap.row.lap)] = parquet_bytes(lap.steps)
    if session.model is not None:
        files[MODEL_FILE] = session.model
    if session.events:
        files[EVENTS_FILE] = parquet_bytes(_rows(session.events, EVENT_SCHEMA))
    return files | {MANIFEST_FILE: manifest_of(files, study)}


def _rows(rows: Sequence[Any], schema: pa.Schema) -> pa.Table:
    values = [asdict(row) for row in rows]
    for value in values:
        if "traits" in value:
            value["traits"] = sorted(value["traits"].items())
    return pa.Table.from_pylist(values, schema=schema)
