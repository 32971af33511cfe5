"""Brier score and reliability bins."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.calibration import calibration_curve
from sklearn.metrics import brier_score_loss

from lad.calibration import brier_score, reliability
from lad.errors import InvalidTargetError

cases = st.lists(st.tuples(st.floats(0.0, 1.0), st.booleans()), min_size=1, max_size=50)


@given(cases)
def test_brier_score_is_sklearns(pairs):
    """Equal to an independent implementation."""
    p, h = np.array([a for a, _ in pairs]), np.array([b for _, b in pairs])
    assert brier_score(p, h) == pytest.approx(brier_score_loss(h, p, labels=[False, True]))


@given(cases, st.integers(1, 12))
def test_bins_account_for_every_prediction(pairs, n_bins):
    """Counts add up, and the weighted means of the bins are the means of all."""
    p, h = np.array([a for a, _ in pairs]), np.array([b for _, b in pairs])
    bins = reliability(p, h, n_bins)
    filled = bins.count > 0
    assert bins.count.sum() == len(p)
    assert np.average(bins.predicted[filled], weights=bins.count[filled]) == pytest.approx(p.mean())
    assert np.average(bins.observed[filled], weights=bins.count[filled]) == pytest.approx(h.mean())
    assert np.isnan(bins.predicted[~filled]).all()
    assert 0.0 <= bins.expected_error <= 1.0
    inside = (bins.predicted >= bins.edges[:-1] - 1e-12) & (
        bins.predicted <= bins.edges[1:] + 1e-12
    )
    assert inside[filled].all()


def test_bins_are_sklearns():
    """Equal to an independent implementation where no prediction lies on an edge."""
    rng = np.random.default_rng(0)
    p = rng.uniform(size=500)
    h = rng.uniform(size=500) < p
    bins = reliability(p, h, 10)
    observed, predicted = calibration_curve(h, p, n_bins=10)
    assert np.abs(bins.predicted - predicted).max() < 1e-12
    assert np.abs(bins.observed - observed).max() < 1e-12
    assert bins.expected_error < 0.08


def test_edges_belong_to_the_bin_above_and_one_to_the_last():
    """0.5 of two bins falls into the upper one, and so does 1."""
    bins = reliability(np.array([0.0, 0.5, 1.0]), np.array([False, True, True]), 2)
    assert bins.count.tolist() == [1, 2]


@pytest.mark.parametrize(
    ("p", "h", "message"),
    [
        ([], [], "given shapes"),
        ([0.5], [True, False], "given shapes"),
        ([1.5], [True], "outside"),
        ([np.nan], [True], "outside"),
        ([0.5], [1], "given dtype int64; allowed is bool"),
    ],
)
def test_what_cannot_be_scored_is_refused(p, h, message):
    """Nothing to score, shapes that differ, no probability, no truth value."""
    truth = np.array(h) if h else np.array([], dtype=bool)
    with pytest.raises(InvalidTargetError, match=message):
        brier_score(np.array(p), truth)


def test_no_bins():
    """There must be a bin."""
    with pytest.raises(InvalidTargetError, match="given 0; allowed is 1 or more"):
        reliability(np.array([0.5]), np.array([True]), 0)
