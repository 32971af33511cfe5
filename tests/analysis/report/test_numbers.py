"""Numbers as a report prints them."""

import math

from hypothesis import given
from hypothesis import strategies as st

from analysis.report.numbers import NOTHING, interval, is_p, number, p_value


@given(st.floats(0, 1))
def test_a_p_value_never_reads_as_zero(p):
    """Small p-values are "< .001"; no p is printed as .000."""
    assert p_value(p) not in (".000", ".00", "0")


def test_no_negative_zero():
    """What rounds to zero has no sign."""
    assert number(-0.04) == "0.0"


def test_what_is_missing_is_a_dash():
    """NaN and infinity are no numbers."""
    assert {number(math.nan), number(math.inf), p_value(math.nan)} == {NOTHING}
    assert interval(math.nan, 1.0) == NOTHING


def test_p_in_a_sentence():
    """With its sign."""
    assert (is_p(0.0001), is_p(0.04)) == ("p < .001", "p = .040")
