"""Ordinal regression of an item."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from statsmodels.miscmodels.ordinal_model import OrderedModel

from analysis.stats.proportional_odds import log_odds_ratios, proportional_odds


def by_statsmodels(a, b):
    """Return the coefficient as statsmodels estimates it."""
    y = np.concatenate([b, a])
    y = np.searchsorted(np.unique(y), y)
    x = np.repeat([0.0, 1.0], [len(b), len(a)])[:, None]
    return OrderedModel(y, x, distr="logit").fit(method="bfgs", disp=0, gtol=1e-8).params[0]


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 10_000), st.integers(15, 40))
def test_the_estimate_is_statsmodels(seed, n):
    """Maximum likelihood agrees with an independent optimiser."""
    rng = np.random.default_rng(seed)
    a, b = rng.integers(1, 6, n), rng.integers(1, 5, n)
    found = proportional_odds(a, b, rng)
    assert found.estimate == pytest.approx(by_statsmodels(a, b), abs=1e-4)


def test_two_points_are_the_odds_ratio():
    """With two answers the model is the 2 x 2 table's log odds ratio."""
    table = np.array([[[8.0, 4.0], [3.0, 9.0]]])
    assert log_odds_ratios(table)[0] == pytest.approx(math.log(9 * 8 / (3 * 4)))


@given(st.lists(st.integers(0, 8), min_size=6, max_size=6))
@settings(deadline=None, max_examples=60)
def test_exchanging_the_conditions_changes_the_sign(counts):
    """Of any table, also one whose likelihood has no maximum."""
    table = np.array(counts, dtype=float).reshape(1, 2, 3)
    if (table.sum(axis=2) == 0).any():
        return
    one, other = log_odds_ratios(table)[0], log_odds_ratios(table[:, ::-1])[0]
    assert one == pytest.approx(-other, abs=1e-5)


def test_separated_answers_say_so():
    """All answers after one condition are above all answers after the other."""
    found = proportional_odds([4, 5, 5, 4], [1, 2, 1, 2], np.random.default_rng(0))
    assert "separate" in found.why_not


@pytest.mark.parametrize(("a", "b"), [([3], [4]), ([3, 3, 3], [3, 3, 3])])
def test_too_little_to_fit_says_why(a, b):
    """One pair, or one answer only."""
    assert not proportional_odds(a, b, np.random.default_rng(0)).computed


def test_the_interval_is_of_participants():
    """Doubling all answers narrows the interval; the estimate stays."""
    rng = np.random.default_rng(5)
    a, b = rng.integers(2, 6, 14), rng.integers(1, 5, 14)
    once = proportional_odds(a, b, np.random.default_rng(0))
    twice = proportional_odds(np.tile(a, 4), np.tile(b, 4), np.random.default_rng(0))
    assert twice.estimate == pytest.approx(once.estimate, abs=1e-6)
    assert twice.high - twice.low < once.high - once.low
