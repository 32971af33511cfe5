"""The reference pages are those that follow from the code."""

import importlib.util
import re
from pathlib import Path

import pytest
from typer.main import get_command

from harness.cli.app import app
from protocols.record.codebook import TABLES
from protocols.study import StudyProtocol

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def pages():
    """Return the pages as they would be written now, by file name."""
    spec = importlib.util.spec_from_file_location("write_reference", DOCS / "write_reference.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    return script.pages()


def test_the_pages_are_current(pages):
    """`make reference` writes them again."""
    stale = [n for n, text in pages.items() if (DOCS / "reference" / n).read_text("utf-8") != text]
    assert stale == []


def test_every_command_has_a_section(pages):
    """Each with its usage."""
    names = get_command(app).commands
    assert [n for n in names if f"## `lad-study {n}`" not in pages["commands.md"]] == []


def test_every_field_and_column_has_an_address(pages):
    """Others can link to a single one."""
    fields = [field.alias or name for name, field in StudyProtocol.model_fields.items()]
    wanted = {f"studyprotocol.{name}" for name in fields}
    assert wanted <= set(re.findall(r'<a id="([^"]+)">', pages["protocol-file.md"]))
    columns = {f"{table}.{column.name}" for table in TABLES for column in TABLES[table]}
    assert columns == set(re.findall(r'<a id="([^"]+)">', pages["record.md"]))


def test_every_option_of_a_shipped_part_is_listed(pages):
    """With its range and what it means, such as the demonstrator's reaction time."""
    (row,) = re.findall(r"^\| .*`reaction_s` \|.*$", pages["part-options.md"], re.MULTILINE)
    assert "number, from 0 to 3" in row
    assert "Median time" in row


def test_no_address_is_given_twice(pages):
    """A link leads to one place."""
    for name, text in pages.items():
        found = re.findall(r'<a id="([^"]+)">', text)
        assert len(found) == len(set(found)), name
