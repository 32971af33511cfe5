"""The two-sample Kolmogorov-Smirnov test."""

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy import stats

from analysis.stats.kolmogorov_smirnov import _distance, stephens_p, two_sample_ks


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10_000), st.integers(2, 15), st.integers(2, 15))
def test_without_ties_it_is_the_librarys_exact_test(seed, m, n):
    """Statistic and p equal scipy's."""
    rng = np.random.default_rng(seed)
    x, y = rng.normal(size=m), rng.normal(0.4, 1, size=n)
    found = two_sample_ks(x, y, same_people=False)
    # Where p is 1, scipy's may come out a rounding error above it, and scipy then refuses.
    assume(m != n or found.statistic > 1 / m + 1e-9)
    expected = stats.ks_2samp(x, y, method="exact")
    assert found.statistic == pytest.approx(expected.statistic)
    assert found.p == pytest.approx(expected.pvalue, abs=1e-9)


@pytest.mark.parametrize("n", range(1, 16))
def test_the_smallest_possible_distance_has_p_one(n):
    """Two samples of n that alternate are nowhere farther apart than 1/n, as close as can be."""
    found = two_sample_ks(np.arange(n) * 2, np.arange(n) * 2 + 1, same_people=False)
    assert found.statistic == pytest.approx(1 / n)
    assert found.p == pytest.approx(1)


@settings(deadline=None, max_examples=25)
@given(st.lists(st.integers(1, 4), min_size=3, max_size=9), st.integers(1, 8))
def test_with_ties_it_is_the_permutation_test(pooled, m):
    """P equals the share of all ways to deal out the pooled values."""
    m = min(m, len(pooled) - 1)
    values = np.array(pooled, dtype=float)
    d = _distance(values[:m], values[m:])
    shares = []
    for chosen in itertools.combinations(range(len(values)), m):
        mask = np.isin(np.arange(len(values)), chosen)
        shares.append(_distance(values[mask], values[~mask]) >= d - 1e-9)
    found = two_sample_ks(values[:m], values[m:], same_people=False)
    assert found.p == pytest.approx(np.mean(shares))


def test_the_papers_p_value_is_stephens():
    """K = 0.3125 gives p = .4370 for 12 against 16; no equal sizes up to 40 give this pair."""
    assert round(stephens_p(0.3125, 12, 16), 4) == 0.4370
    for n in range(5, 41):
        possible = np.isclose(0.3125 * n, round(0.3125 * n))
        assert not (possible and round(stephens_p(0.3125, n, n), 4) == 0.4370)


def test_the_same_people_make_it_descriptive():
    """The assumption that fails is said."""
    assert "descriptive" in two_sample_ks([1, 2], [2, 3], same_people=True).notes[2]
    assert len(two_sample_ks([1, 2], [2, 3], same_people=False).notes) == 2


def test_an_empty_sample_says_why():
    """Nothing to compare."""
    assert two_sample_ks([], [1.0], same_people=False).why_not


def test_large_samples_are_asymptotic():
    """A hundred against a hundred and more."""
    rng = np.random.default_rng(0)
    found = two_sample_ks(rng.normal(size=120), rng.normal(size=120), same_people=False)
    assert "asymptotic" in found.method
