"""docs/cohort.md gives the numbers that are in the code."""

from pathlib import Path

import pytest

from participants.population import PEOPLE, TRAITS
from protocols.shipped_parts import IMPAIRMENTS

PAGE = (Path(__file__).parents[2] / "docs" / "cohort.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", TRAITS)
def test_every_trait_is_described_with_its_distribution(name):
    """Range, median and spread stand in the trait's row."""
    rows = [row.split(" | ") for row in PAGE.splitlines() if row.startswith(f"| `{name}` | ")]
    trait, marginal = TRAITS[name], PEOPLE.marginals[name]
    numbers = (
        f"{trait.low:g} to {trait.high:g}",
        f"{marginal.median:g} ({marginal.spread:g})",
    )
    assert any(set(numbers) <= set(row) for row in rows)


def test_every_correlation_is_listed():
    """As it is, and none besides."""
    listed = {row for row in PAGE.splitlines() if row.count("`") == 4 and row.count("|") == 4}
    assert listed == {f"| `{a}` | `{b}` | {r:g} |" for (a, b), r in PEOPLE.correlations.items()}


@pytest.mark.parametrize("name", IMPAIRMENTS)
def test_every_impairment_is_described(name):
    """With what it does and what its severity means."""
    assert f"| `{name}` | " in PAGE
