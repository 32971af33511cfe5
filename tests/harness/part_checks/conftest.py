"""Other people's parts, importable here and in other processes."""

import sys
from pathlib import Path

import pytest

from harness.part_checks import Setting


@pytest.fixture
def their_parts(monkeypatch):
    """Put the module with other people's parts where it can be imported from."""
    monkeypatch.syspath_prepend(str(Path(__file__).parent))
    sys.modules.pop("their_parts", None)
    yield
    sys.modules.pop("their_parts", None)


@pytest.fixture(scope="session")
def brief():
    """Return a setting with laps that are just long enough to tell."""
    return Setting(lap_s=5.0)
