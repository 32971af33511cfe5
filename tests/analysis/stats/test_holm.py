"""Holm's correction."""

import math

from hypothesis import given
from hypothesis import strategies as st

from analysis.stats.holm import holm

FAMILY = st.lists(st.floats(0, 1), min_size=1, max_size=8)


@given(FAMILY)
def test_adjusting_never_makes_p_smaller_and_keeps_the_order(p):
    """Corrected values are at least the raw ones, at most one, and rank alike."""
    adjusted = holm(p)
    assert all(raw <= a <= 1 for raw, a in zip(p, adjusted, strict=True))
    by_raw = [a for _, a in sorted(zip(p, adjusted, strict=True))]
    assert by_raw == sorted(by_raw)


@given(FAMILY)
def test_it_rejects_no_less_than_bonferroni(p):
    """Holm's values are never above m times p."""
    assert all(a <= min(1, len(p) * raw) + 1e-12 for raw, a in zip(p, holm(p), strict=True))


def test_a_test_that_failed_still_counts():
    """The family is what was declared: a missing p makes the others no smaller."""
    adjusted = holm([0.01, math.nan, 0.02])
    assert adjusted[0] == 0.03
    assert math.isnan(adjusted[1])
    assert adjusted[2] == 0.04
