"""Sign flips over participants."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from analysis.stats.permutation import EXACT_UP_TO, sign_flip


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000), st.integers(2, 9))
def test_few_pairs_are_exact(seed, n):
    """P equals scipy's exact permutation test of the same statistic."""
    d = np.random.default_rng(seed).normal(0.5, 1, n)
    expected = stats.permutation_test(
        (d,), np.mean, permutation_type="samples", n_resamples=np.inf
    ).pvalue
    assert sign_flip(d, np.random.default_rng(0)).p == pytest.approx(expected)


def test_many_pairs_are_drawn_and_never_give_zero():
    """A Monte Carlo p counts the data itself, so it cannot be zero."""
    d = np.full(EXACT_UP_TO + 10, 1.0) + np.random.default_rng(0).normal(0, 0.1, EXACT_UP_TO + 10)
    found = sign_flip(d, np.random.default_rng(0))
    assert found.p == pytest.approx(1 / 10_000)
    assert "draws" in found.method


@pytest.mark.parametrize("d", [[1.0], [0.0, 0.0]])
def test_too_little_to_test_says_why(d):
    """One pair, or no difference."""
    assert not sign_flip(d, np.random.default_rng(0)).computed
