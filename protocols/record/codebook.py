"""The codebook: every column of the record, generated from the schema."""

import json
from typing import Any

from protocols.record.column import SCHEMA_VERSION, Column
from protocols.record.steps import STEP_COLUMNS
from protocols.record.tables import EVENT_COLUMNS, LAP_COLUMNS, PARTICIPANT_COLUMNS, SURVEY_COLUMNS

CODEBOOK_FILE = "codebook.json"

TABLES: dict[str, tuple[Column, ...]] = {
    "participants": PARTICIPANT_COLUMNS,
    "laps": LAP_COLUMNS,
    "surveys": SURVEY_COLUMNS,
    "steps": STEP_COLUMNS,
    "events": EVENT_COLUMNS,
}
"""The record's tables by name."""


def codebook() -> dict[str, Any]:
    """Return every table's columns: name, type, unit, description, allowed values, and so on.

    Examples
    --------
    >>> codebook()["tables"]["laps"][1]["name"]
    'lap'
    """
    tables = {name: [_entry(c) for c in columns] for name, columns in TABLES.items()}
    return {"schema": SCHEMA_VERSION, "tables": tables}


def codebook_json() -> str:
    """Return the codebook as the text of ``codebook.json``.

    Examples
    --------
    >>> json.loads(codebook_json()) == codebook()
    True
    """
    return json.dumps(codebook(), indent=1, ensure_ascii=False) + "\n"


def _entry(column: Column) -> dict[str, Any]:
    return {
        "name": column.name,
        "type": str(column.type),
        "unit": column.unit,
        "description": column.description,
        "allowed": column.allowed,
        "nullable": column.nullable,
        "since": column.since,
    }
