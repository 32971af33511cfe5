"""Reliability of a scale."""

import numpy as np
import pytest

from analysis.stats.cronbach_alpha import cronbach_alpha


def test_copies_of_one_item_are_perfectly_reliable():
    """Alpha of an item asked three times is 1."""
    item = np.random.default_rng(0).integers(1, 6, 20)
    assert cronbach_alpha(np.column_stack([item] * 3)).estimate == pytest.approx(1.0)


def test_unrelated_items_are_not_reliable():
    """Alpha of independent items is near 0, and its interval holds 0."""
    found = cronbach_alpha(np.random.default_rng(0).normal(size=(400, 4)))
    assert found.low < 0 < found.high


@pytest.mark.parametrize(
    "answers", [[[1], [2], [3]], [[1, 2], [2, 3]], [[3, 3], [3, 3], [3, 3]], np.empty((0, 4))]
)
def test_what_has_no_reliability_says_why(answers):
    """One item, two people, no spread, no people."""
    assert not cronbach_alpha(answers).computed


def test_incomplete_sheets_are_left_out_and_counted():
    """A missing answer takes its sheet out."""
    found = cronbach_alpha([[1, 2], [2, 2], [3, 4], [5, 5], [4, np.nan]])
    assert found.n == 4
    assert found.notes == ("1 incomplete answer sheets left out",)
