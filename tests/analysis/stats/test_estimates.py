"""Ratios, effect sizes, their bootstrap intervals, and descriptions."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from analysis.stats.bootstrap import bca_interval
from analysis.stats.describe import describe
from analysis.stats.effect_size import cohen_dz, rank_biserial
from analysis.stats.mean_difference import mean_difference
from analysis.stats.permutation import sign_flip
from analysis.stats.ratio import mean_of_ratios, ratio_of_means
from analysis.stats.samples import present_pairs
from analysis.stats.signed_rank import signed_rank
from analysis.stats.tost import paired_tost


def rng():
    """Return a fresh generator, always the same."""
    return np.random.default_rng(7)


REFERENCE, CONDITION = (
    np.array([60.0, 80, 90, 75, 66, 84, 91]),
    np.array([50.0, 60, 62, 61, 40, 63, 70]),
)


def test_the_papers_speedup_is_the_ratio_of_means():
    """76.7 s over 56.1 s is 137%."""
    assert round(100 * ratio_of_means([76.7], [56.1]).estimate) == 137


def test_the_two_ratios_differ_and_lie_in_their_intervals():
    """Both are computed over complete pairs, with participants resampled together."""
    of_means = ratio_of_means(REFERENCE, CONDITION)
    of_ratios = mean_of_ratios(REFERENCE, CONDITION)
    assert of_means.estimate == pytest.approx(REFERENCE.mean() / CONDITION.mean())
    assert of_ratios.estimate == pytest.approx((REFERENCE / CONDITION).mean())
    assert of_means.low < of_means.estimate < of_means.high
    assert of_ratios.low < of_ratios.estimate < of_ratios.high


def test_incomplete_pairs_are_left_out():
    """A missing half takes the other half with it."""
    with_gap = ratio_of_means([60, 80, np.nan], [50, np.nan, 40])
    assert (with_gap.n, with_gap.estimate) == (1, pytest.approx(1.2))
    assert ratio_of_means([np.nan], [1.0]).why_not == "no pair is complete"


def test_pairs_of_unequal_length_are_a_mistake():
    """Pairing by position needs equal lengths."""
    with pytest.raises(ValueError, match="given 2 and 1"):
        present_pairs([1.0, 2.0], [1.0])


def test_the_same_generator_gives_the_same_interval():
    """Bootstrap draws come from the generator alone."""
    once = cohen_dz(REFERENCE - CONDITION, rng())
    assert repr(cohen_dz(REFERENCE - CONDITION, rng())) == repr(once)


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10_000), st.integers(3, 20))
def test_turning_a_speedup_round_turns_its_interval(seed, n):
    """Fieller's interval of b / a holds the inverses of that of a / b."""
    draws = np.random.default_rng(seed)
    a, b = draws.uniform(50, 60, n), draws.uniform(30, 50, n)
    one, other = ratio_of_means(a, b), ratio_of_means(b, a)
    assert (one.low, one.high) == pytest.approx((1 / other.high, 1 / other.low))


def test_a_mean_that_may_be_zero_has_no_interval():
    """Where the denominator is not told from zero, the set of ratios has no two ends."""
    found = ratio_of_means([1.0, 2.0, 3.0], [-5.0, 1.0, 6.0])
    assert math.isnan(found.low)


def test_bca_agrees_with_the_library_on_a_mean():
    """A sanity check against another implementation's percentile for a symmetric sample."""
    x = rng().normal(size=60)
    low, high = bca_interval((x,), np.mean, rng())
    about = stats.bootstrap((x,), np.mean, method="percentile", rng=rng()).confidence_interval
    assert (low, high) == pytest.approx((about.low, about.high), abs=0.05)


@pytest.mark.parametrize("x", [np.ones(10), np.arange(5.0)], ids=["constant", "five"])
def test_what_has_no_bootstrap_interval_has_none(x):
    """No spread, or too few participants."""
    assert all(math.isnan(end) for end in bca_interval((x,), np.mean, rng()))


@settings(deadline=None, max_examples=20)
@given(st.lists(st.floats(-50, 50), min_size=2, max_size=12).filter(lambda d: np.ptp(d) > 1e-3))
def test_effect_sizes_flip_with_the_comparison(d):
    """Exchanging the conditions changes the sign of d_z and of the rank-biserial correlation."""
    turned = [-v for v in d]
    assert cohen_dz(d, rng()).estimate == pytest.approx(-cohen_dz(turned, rng()).estimate)
    one, other = rank_biserial(d, rng()), rank_biserial(turned, rng())
    assert one.estimate == pytest.approx(-other.estimate)
    assert -1 <= one.estimate <= 1


def test_when_all_differences_agree_in_sign():
    """Rank-biserial is 1, and a bootstrap of it has nothing to vary: said, not faked."""
    found = rank_biserial(np.arange(1.0, 11), rng())
    assert found.estimate == 1
    assert math.isnan(found.low)
    assert "one sign" in found.notes[0]


@pytest.mark.parametrize("test", [cohen_dz, rank_biserial])
def test_few_participants_have_an_effect_without_interval_and_a_note(test):
    """Five people: a number, no interval, and why; the method speaks of no bootstrap."""
    found = test([1.0, 2.0, -1.0, 3.0, 0.5], rng())
    assert math.isfinite(found.estimate)
    assert math.isnan(found.low)
    assert found.notes == ("no bootstrap interval of fewer than 6 participants",)
    assert "bootstrap" not in found.method


@pytest.mark.parametrize("test", [cohen_dz, rank_biserial])
def test_effects_that_cannot_be_computed_say_why(test):
    """Nothing, or no difference."""
    assert test([], rng()).why_not
    assert test([0.0, 0.0, 0.0], rng()).why_not


@pytest.mark.parametrize("d", [[2.0, 2.0, 2.0], [0.3 - 0.2, 0.2 - 0.1], [1.5]])
def test_differences_without_spread_have_a_mean_and_no_test(d):
    """Equal ones, whatever the seventeenth digit says, and a single one."""
    found = mean_difference(d)
    assert found.estimate == pytest.approx(d[0])
    assert np.isnan([found.low, found.high, found.p]).all()
    assert found.notes
    assert not cohen_dz(d, np.random.default_rng(0)).computed
    assert not paired_tost(d, 5.0).computed


@given(st.lists(st.tuples(st.integers(300, 900), st.integers(300, 900)), min_size=3, max_size=14))
def test_the_unit_decides_no_rank(pairs):
    """Times to a tenth of a second: ties, zeros and p are those of whole tenths."""
    a, b = np.array(pairs, dtype=float).T
    whole, tenths = signed_rank(b - a), signed_rank(b / 10 - a / 10)
    assert whole.p == pytest.approx(tenths.p, nan_ok=True)
    assert whole.notes == tenths.notes
    rng = np.random.default_rng
    assert sign_flip(b - a, rng(0)).p == pytest.approx(
        sign_flip(b / 10 - a / 10, rng(0)).p, nan_ok=True
    )
    assert rank_biserial(b - a, rng(0)).estimate == pytest.approx(
        rank_biserial(b / 10 - a / 10, rng(0)).estimate, nan_ok=True
    )


def test_coverage_of_the_d_z_interval_is_near_nominal():
    """About 95 in 100 bootstrap intervals hold the true effect (n = 20, true d_z = 0.8)."""
    draws = np.random.default_rng(1)
    held = []
    for _ in range(120):
        found = cohen_dz(draws.normal(0.8, 1, 20), draws)
        held.append(found.low <= 0.8 <= found.high)
    assert 0.87 <= np.mean(held) <= 1.0


def test_a_description_counts_what_is_missing():
    """Missing values are counted, not averaged; one value has no sd."""
    found = describe([1.0, np.nan, np.nan])
    assert (found.n, found.missing, found.mean) == (1, 2, 1.0)
    assert math.isnan(found.sd)
    assert describe([]).n == 0
