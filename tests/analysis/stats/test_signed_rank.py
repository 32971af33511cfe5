"""Wilcoxon's signed-rank test: exactness, symmetry, and what it says when it cannot."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from analysis.stats.signed_rank import EXACT_UP_TO, signed_rank, signed_ranks

LIKERT = st.lists(st.integers(-4, 4), min_size=1, max_size=9).filter(any)


def by_enumeration(d, zeros):
    """Return the exact two-sided p by trying every assignment of signs."""
    kept, ranks = signed_ranks(np.array(d, dtype=float), zeros)
    observed = ranks[kept > 0].sum()
    middle = ranks.sum() / 2
    sums = [
        sum(r for r, sign in zip(ranks, signs, strict=True) if sign)
        for signs in itertools.product([0, 1], repeat=len(ranks))
    ]
    return np.mean([abs(s - middle) >= abs(observed - middle) - 1e-9 for s in sums])


@settings(deadline=None)
@given(LIKERT, st.sampled_from(["pratt", "wilcoxon"]))
def test_p_is_exact_with_ties_and_zeros(d, zeros):
    """The p-value equals brute force over all signs."""
    assert signed_rank(d, zeros=zeros).p == pytest.approx(by_enumeration(d, zeros))


@settings(deadline=None)
@given(LIKERT)
def test_turning_the_comparison_round_turns_the_result(d):
    """Exchanging the conditions flips estimate and interval and leaves p alone."""
    one, other = signed_rank(d), signed_rank([-v for v in d])
    assert one.p == pytest.approx(other.p)
    assert one.estimate == pytest.approx(-other.estimate)
    if np.isfinite(one.low):
        assert (one.low, one.high) == pytest.approx((-other.high, -other.low))


def test_many_pairs_take_the_normal_approximation():
    """Above the limit the method says so, and p is close to the library's."""
    d = np.random.default_rng(0).normal(0.1, 1, EXACT_UP_TO + 50)
    found = signed_rank(d)
    assert "normal approximation" in found.method
    assert found.p == pytest.approx(stats.wilcoxon(d, method="asymptotic").pvalue)
    assert found.low < found.estimate < found.high


@pytest.mark.parametrize(
    ("d", "why"), [([], "no pair is complete"), ([0.0, 0.0], "every difference is zero")]
)
def test_what_cannot_be_ranked_says_why(d, why):
    """No pairs, or no difference at all."""
    assert signed_rank(d).why_not == why


def test_ties_zeros_and_few_pairs_are_stated():
    """A reader must know them to judge the p-value."""
    notes = signed_rank([1, 1, -1, 0, 2]).notes
    assert notes == (
        "1 of 5 differences are zero",
        "3 of 5 differences are tied",
        "5 pairs are too few for an interval of this level",
    )


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10_000), st.integers(6, 20))
def test_the_interval_is_what_the_test_does_not_reject(seed, n):
    """Shifting just inside the interval is not rejected at 5%, just outside it is."""
    d = np.random.default_rng(seed).normal(0.5, 1, n)
    found = signed_rank(d)
    edge = 1e-6
    assert signed_rank(d - (found.low + edge)).p > 0.05
    assert signed_rank(d - (found.low - edge)).p <= 0.05
