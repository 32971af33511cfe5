"""Records of version 1 are read, checked and enlarged as they were."""

import json
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from protocols.record.check import check_study
from protocols.record.codebook import TABLES
from protocols.record.column import SCHEMA_VERSION, arrow_schema, brought_up_to_date
from protocols.record.header import read_header
from protocols.record.manifest import entry
from protocols.record.reader import open_study
from protocols.record.store import build_tables
from protocols.resolved import ResolvedStudy

FILES = {
    "participant_row.parquet": "participants",
    "lap_rows.parquet": "laps",
    "survey_rows.parquet": "surveys",
}


def as_version_1(session: Path) -> None:
    """Rewrite a session as the first version of the record had it."""
    manifest = json.loads((session / "manifest.json").read_text())
    for path in session.glob("*.parquet"):
        columns = TABLES[FILES.get(path.name, "steps")]
        table = pq.read_table(path)
        old = arrow_schema(columns, 1)
        pq.write_table(table.select(old.names).cast(old), path)
        manifest["files"][path.name] = entry(path.read_bytes()).model_dump()
    manifest["schema"] = 1
    (session / "manifest.json").write_text(json.dumps(manifest))


@pytest.fixture
def mixed(folder: Path) -> Path:
    """Return a study whose first session is of version 1."""
    as_version_1(folder / "sessions" / "P0001")
    build_tables(folder)
    return folder


def test_every_later_column_may_be_missing():
    """Otherwise an older record could not be read."""
    later = [c for columns in TABLES.values() for c in columns if c.since > 1]
    assert later
    assert all(column.nullable and column.since <= SCHEMA_VERSION for column in later)


def test_a_study_of_both_versions_is_whole(mixed: Path):
    """An old session stays as it is; its later columns are missing in the tables."""
    assert check_study(mixed) == ()
    study = open_study(mixed)
    assert study.laps["pauses"].null_count == len(study.laps)
    assert study.steps("P0001", 0)["input_age_s"].null_count == 5


def test_a_header_of_version_1_says_where_the_study_is_from(folder: Path, plan: ResolvedStudy):
    """With a seed it was simulated."""
    path = folder / "study.yaml"
    text = path.read_text().replace("schema: 2", "schema: 1", 1)
    kept = [line for line in text.splitlines() if not line.startswith("origin:")]
    path.write_text("\n".join(kept) + "\n")
    header = read_header(folder)
    assert header.origin == "simulated"
    assert header.study.protocol == plan.protocol


def test_other_columns_are_not_a_version():
    """A table with a strange column, or in another order, is not brought up to date."""
    columns = TABLES["laps"]
    table = arrow_schema(columns, 1).empty_table()
    assert brought_up_to_date(table, columns).schema == arrow_schema(columns)
    assert brought_up_to_date(table.append_column("x", pa.array([], pa.int8())), columns) is None
    assert brought_up_to_date(table.select(table.column_names[::-1]), columns) is None
