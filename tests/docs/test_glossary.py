"""docs/glossary.md names only what exists."""

import importlib
import re
from pathlib import Path
from typing import Any

import pytest

from protocols.record.codebook import TABLES

PAGE = (Path(__file__).parents[2] / "docs" / "glossary.md").read_text(encoding="utf-8")
ROWS = [
    re.split(r"(?<!\\)\|", line)[1:-1]
    for line in PAGE.splitlines()
    if line.startswith("| ") and not line.startswith("| symbol ")
]
NAMES = sorted({name for row in ROWS for name in re.findall(r"`([^`]+)`", row[-1])})
PACKAGES = ("lad", "protocols", "participants", "harness", "analysis")


def _is_column(name: str) -> bool:
    table, _, column = name.partition(".")
    return table in TABLES and column in {known.name for known in TABLES[table]}


def _exists(name: str) -> bool:
    """Whether a module, what it defines, or a field or property of a class has this name."""
    parts = name.split(".")
    if parts[0] not in PACKAGES:
        return False
    for n in range(len(parts), 0, -1):
        try:
            found: Any = importlib.import_module(".".join(parts[:n]))
        except ModuleNotFoundError:
            continue
        return _has(found, parts[n:])
    return False


def _has(found: Any, parts: list[str]) -> bool:
    for at, part in enumerate(parts):
        if part in getattr(found, "__annotations__", {}):
            return at == len(parts) - 1
        if not hasattr(found, part):
            return False
        found = getattr(found, part)
    return True


@pytest.mark.parametrize("name", NAMES)
def test_every_name_exists(name):
    """Each name under "where" is a column of the record, or can be imported."""
    assert _is_column(name) or _exists(name)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[1].strip())
def test_every_row_is_complete(row):
    """Four cells; name and meaning are there, and at least one place."""
    assert len(row) == 4
    assert row[1].strip()
    assert row[2].strip()
    assert re.search(r"`[^`]+`", row[3])


@pytest.mark.parametrize("name", ["laps.nothing", "steps.lap_time_s", "lad.nothing", "os.path"])
def test_a_wrong_name_is_noticed(name):
    """A name of another table, of no module or of another package does not pass."""
    assert not _is_column(name)
    assert not _exists(name)
