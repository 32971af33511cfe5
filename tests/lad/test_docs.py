"""The page about the model says what the code does."""

import doctest
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[2] / "docs" / "stork-gp.md"


def test_examples_on_the_page_run():
    """Every example of the page gives what it shows."""
    results = doctest.testfile(str(PAGE), module_relative=False, verbose=False)
    assert results.attempted > 8
    assert results.failed == 0


@pytest.mark.parametrize("equation", range(1, 11))
def test_every_equation_is_named(equation):
    """The page names each of the paper's ten equations."""
    assert f"({equation})" in PAGE.read_text(encoding="utf-8")
