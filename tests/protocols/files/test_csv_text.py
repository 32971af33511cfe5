"""No spreadsheet takes text for a formula."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocols.files.csv_text import csv_text, harmless


@pytest.mark.parametrize("text", ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1", " =1", "＝1"])
def test_what_begins_like_a_formula_has_an_apostrophe(text):
    """As spreadsheets themselves mark text."""
    assert harmless(text) == f"'{text}"


@given(st.lists(st.text(st.characters(codec="utf-8", exclude_characters="\r\0")), min_size=1))
def test_text_comes_back_apart_from_the_apostrophe(cells):
    """Quotes, commas and line ends survive; every cell is its text or that with one apostrophe."""
    (row,) = csv.reader(io.StringIO(csv_text([cells]), newline=""))
    assert all(back in {cell, f"'{cell}"} for back, cell in zip(row, cells, strict=True))


@pytest.mark.parametrize("value", [-2.5, 3, True, None])
def test_numbers_are_no_text(value):
    """A negative number stays one."""
    assert harmless(value) is value
