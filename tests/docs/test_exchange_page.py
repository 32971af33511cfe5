"""The page on exchange is true: its files are valid, and its commands and formats exist."""

import re
from pathlib import Path

import pytest
from typer.main import get_command

from analysis.export.registry import GROUP, SHIPPED
from harness.cli.app import app
from protocols.importing.map.route import Route
from protocols.importing.mapping_file import read_mapping

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "exchange.md").read_text()
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def test_its_route_and_its_mapping_are_valid(tmp_path):
    """They can be copied from the page."""
    mapping = pytest.importorskip("harness.importing.mapping")
    route, bag = (text for language, text in BLOCKS if language == "yaml")
    (tmp_path / "route.yaml").write_text(route)
    (tmp_path / "bag.yaml").write_text(bag)
    assert len(read_mapping(tmp_path / "route.yaml", Route)[0].via) == 3
    assert read_mapping(tmp_path / "bag.yaml", mapping.BagMapping)[0].demonstrated


def test_its_commands_exist():
    """Every command line names a command and options that there are."""
    lines = [line for language, text in BLOCKS if language == "sh" for line in text.splitlines()]
    lines = [line.partition(" > ")[0] for line in lines]
    assert len(lines) > 6
    for line in lines:
        words = line.split()[1:]
        command = get_command(app)
        while words and words[0] in getattr(command, "commands", {}):
            command = command.commands[words.pop(0)]
        known = {option for parameter in command.params for option in parameter.opts}
        assert {word for word in words if word.startswith("--")} <= known, line


def test_every_format_is_on_the_page():
    """With its name, and the group for other people's."""
    assert all(f"| `{name}` |" in PAGE for name in SHIPPED)
    assert GROUP in PAGE


def test_its_pictures_are_there():
    """Every picture the page shows."""
    pictures = re.findall(r"!\[[^]]*\]\(([^)]+)\)", PAGE)
    assert len(pictures) == 3
    assert all((ROOT / "docs" / name).is_file() for name in pictures)
