"""Equivalence."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analysis.stats.tost import paired_tost


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 10_000), st.floats(0.1, 5))
def test_equivalence_and_interval_agree(seed, margin):
    """P is below 5% exactly when the 90% interval lies within the margin."""
    found = paired_tost(np.random.default_rng(seed).normal(0.2, 1, 12), margin)
    assert (found.p < 0.05) == (-margin < found.low and found.high < margin)


def test_power_is_what_the_textbook_says():
    """Differences with sd 8 s, margin 5 s: power 0.32 at n = 12 and 0.81 at n = 24."""
    rng = np.random.default_rng(3)
    for n, power in ((12, 0.32), (24, 0.81)):
        found = np.mean([paired_tost(rng.normal(0, 8, n), 5.0).p < 0.05 for _ in range(1500)])
        assert found == pytest.approx(power, abs=0.04)


def test_a_margin_must_be_above_zero():
    """Zero or negative margins mean nothing."""
    with pytest.raises(ValueError, match="allowed: above 0"):
        paired_tost([1.0, 2.0], 0.0)


@pytest.mark.parametrize("d", [[1.0], [2.0, 2.0]])
def test_too_little_to_test_says_why(d):
    """One pair, or no spread."""
    assert not paired_tost(d, 1.0).computed
