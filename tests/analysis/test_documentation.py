"""The page about the analysis says what there is."""

from pathlib import Path

import pytest

from analysis.measures.registry import MEASURES
from protocols.record.elsewhere.rules import LAPS, PARTICIPANTS, STEPS, SURVEYS

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "analysis.md").read_text("utf-8")
OWN_DATA = (DOCS / "bring-your-own-data.md").read_text("utf-8")


@pytest.mark.parametrize("m", MEASURES, ids=lambda m: m.name)
def test_every_measure_is_described(m):
    """With its name and meaning, as the registry has them."""
    assert f"`{m.name}`" in PAGE
    assert m.meaning in PAGE


@pytest.mark.parametrize("rules", [PARTICIPANTS, LAPS, SURVEYS, STEPS])
def test_minimal_columns_are_those_the_reader_asks_for(rules):
    """Who records elsewhere learns every column that must be there."""
    assert ", ".join(f"`{name}`" for name in rules.required) in OWN_DATA


def test_every_test_function_is_named():
    """Each file of analysis/stats that returns results has its function on the page."""
    folder = Path(__file__).parents[2] / "analysis" / "stats"
    for path in folder.glob("*.py"):
        text = path.read_text("utf-8")
        functions = [
            line.split("(")[0].removeprefix("def ")
            for line in text.splitlines()
            if line.startswith("def ") and not line.startswith("def _")
        ]
        if "TestResult" in text and functions and path.stem != "result":
            assert any(f"`{name}`" in PAGE for name in functions), path.name
