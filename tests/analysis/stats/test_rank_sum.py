"""Wilcoxon's rank-sum test against enumeration and scipy."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from analysis.stats.rank_sum import rank_sum

values = st.lists(st.integers(0, 6), min_size=1, max_size=5)


@given(values, values)
def test_p_is_that_of_every_choice_of_people(a, b):
    """With ties too: the share of choices of a group whose sum is as extreme, doubled."""
    both = np.array(a + b, dtype=float)
    found = rank_sum(a, b)
    if np.ptp(both) == 0:
        assert found.why_not is not None
        return
    ranks = stats.rankdata(both)
    sums = [sum(ranks[list(c)]) for c in itertools.combinations(range(len(both)), len(a))]
    observed = ranks[: len(a)].sum()
    below = np.mean([s <= observed + 1e-9 for s in sums])
    above = np.mean([s >= observed - 1e-9 for s in sums])
    assert found.p == pytest.approx(min(1.0, 2 * min(below, above)))


def test_without_ties_it_is_scipys_and_shifts_with_the_group():
    """Exact p of 8 against 9; the estimate and interval move with the group by the same amount."""
    rng = np.random.default_rng(0)
    a, b = rng.normal(0.8, 1, 8), rng.normal(0, 1, 9)
    found = rank_sum(a, b)
    assert found.p == pytest.approx(stats.mannwhitneyu(a, b, method="exact").pvalue)
    moved = rank_sum(a + 3, b)
    for end in ("estimate", "low", "high"):
        assert getattr(moved, end) == pytest.approx(getattr(found, end) + 3)


def test_the_interval_holds_the_shifts_that_are_not_rejected():
    """Just inside its ends a shift is not rejected at 5%, just outside it is."""
    rng = np.random.default_rng(3)
    a, b = rng.normal(1, 1, 7), rng.normal(0, 1, 8)
    found = rank_sum(a, b)
    for shift, inside in ((found.low + 1e-6, True), (found.low - 1e-6, False),
                          (found.high - 1e-6, True), (found.high + 1e-6, False)):  # fmt: skip
        assert (rank_sum(a - shift, b).p > 0.05) == inside


def test_large_groups_are_approximated():
    """Beyond a hundred people the normal approximation agrees with scipy's without continuity."""
    rng = np.random.default_rng(1)
    a, b = rng.normal(0.2, 1, 70), rng.normal(0, 1, 60)
    wanted = stats.mannwhitneyu(a, b, method="asymptotic", use_continuity=False).pvalue
    assert rank_sum(a, b).p == pytest.approx(wanted)
