"""The published JSON Schemas."""

import json
from pathlib import Path

import pytest

from protocols.json_schema import json_schemas, write_json_schemas

_PUBLISHED = Path(__file__).parents[2] / "docs" / "schema"


@pytest.mark.parametrize("name", json_schemas())
def test_the_published_schema_is_current(name: str):
    """The files hold what the models say; `python -m protocols.json_schema` renews it."""
    assert (_PUBLISHED / name).read_text(encoding="utf-8") == json_schemas()[name]


def test_ranges_and_choices_reach_the_schema():
    """An editor sees what validation enforces: bounds, alternatives, no unknown fields."""
    schema = json.loads(json_schemas()["protocol.json"])
    capacity = schema["$defs"]["LADParameters"]["properties"]["capacity"]
    assert (capacity["minimum"], capacity["maximum"]) == (1, 20_000)
    assistant = schema["$defs"]["Condition"]["properties"]["assistant"]
    assert assistant["enum"] == ["none", "demonstrator", "model"]
    assert schema["additionalProperties"] is False
    assert "schema" in schema["properties"]


def test_writing_gives_every_file(tmp_path: Path):
    """The command writes exactly the published files."""
    write_json_schemas(tmp_path)
    assert {p.name for p in tmp_path.iterdir()} == {p.name for p in _PUBLISHED.iterdir()}
