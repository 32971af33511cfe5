"""The fields of files are explained where people look them up."""

import json
from pathlib import Path

import pytest

from protocols.declared import LAP_OUTCOMES
from protocols.json_schema import json_schemas

_PAGE = (Path(__file__).parents[2] / "docs" / "protocols.md").read_text(encoding="utf-8")
_SCHEMAS = {name: json.loads(text) for name, text in json_schemas().items()}
_PARTS = [
    pytest.param(part, id=f"{file} {name}")
    for file, schema in _SCHEMAS.items()
    for name, part in {**schema["$defs"], "file": schema}.items()
    if "properties" in part
]


@pytest.mark.parametrize("part", _PARTS)
def test_every_field_says_what_it_means(part):
    """Editors and the reference pages show a sentence for each field."""
    silent = [name for name, field in part["properties"].items() if not field.get("description")]
    assert silent == []


@pytest.mark.parametrize("field", _SCHEMAS["protocol.json"]["properties"])
def test_the_page_names_every_part_of_a_protocol(field):
    """Who reads the page from top to bottom has met every field of the first level."""
    assert f"`{field}`" in _PAGE


def test_outcomes_are_documented():
    """Every outcome that a comparison may name."""
    assert all(f"`{outcome}`" in _PAGE for outcome in LAP_OUTCOMES)


def test_the_page_has_no_long_paragraphs():
    """What would take one is a table: no paragraph is longer than 600 characters."""
    prose = [block for block in _PAGE.split("\n\n") if not block.startswith(("|", "`"))]
    assert [block for block in prose if len(block) > 600] == []
