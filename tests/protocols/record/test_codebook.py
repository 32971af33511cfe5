"""The codebook says what the record holds."""

import json
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from protocols.record.codebook import TABLES, codebook, codebook_json


@pytest.mark.parametrize(
    ("table", "file"),
    [
        ("participants", "participants.parquet"),
        ("laps", "laps.parquet"),
        ("surveys", "surveys.parquet"),
        ("steps", "sessions/P0001/steps-1.parquet"),
    ],
)
def test_the_codebook_of_a_study_describes_its_files(folder: Path, table: str, file: str):
    """Names, order, types and missing values in codebook.json are those of the Parquet files."""
    entries = json.loads((folder / "codebook.json").read_text(encoding="utf-8"))["tables"][table]
    schema = pq.read_schema(folder / file)
    assert [e["name"] for e in entries] == schema.names
    # Parquet gives a map the name of its column; the type is the same.
    types = [str(field.type).replace(f" ('{field.name}')", "") for field in schema]
    assert [e["type"] for e in entries] == types
    assert [e["nullable"] for e in entries] == [field.nullable for field in schema]


@pytest.mark.parametrize("table", TABLES)
def test_every_column_is_described(table: str):
    """No column without a description; names are unique."""
    entries = codebook()["tables"][table]
    assert all(len(entry["description"]) > 2 for entry in entries)
    assert len({entry["name"] for entry in entries}) == len(entries)


def test_the_text_is_the_codebook():
    """codebook.json holds exactly the generated codebook."""
    assert json.loads(codebook_json()) == codebook()
