"""Accuracy of predictions, against scikit-learn."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn import metrics

from analysis.reproduction.accuracy import accuracy_table, auc, pooled, rmse, spread
from analysis.reproduction.figures.roc import roc_curve
from analysis.reproduction.teaching import PredictedLap

SEEDS = st.integers(0, 2**32 - 1)


def random_lap(seed, steps=60, lap=0):
    """Return a lap of noise, with ties in p(h)."""
    rng = np.random.default_rng(seed)
    helped = rng.random(steps) < 0.3
    helped[:2] = True, False
    action = np.where(helped[:, None], rng.normal(size=(steps, 2)), np.nan)
    return PredictedLap(
        lap=lap, t=np.arange(steps) * 0.1, helped=helped, action=action,
        p_help=rng.integers(0, 20, steps) / 20, mean=rng.normal(size=(steps, 2)),
        variance=np.ones(steps),
    )  # fmt: skip


@given(SEEDS)
def test_auc_and_curve_are_scikit_learns(seed):
    """Area and curve agree with another implementation, ties included."""
    lap = random_lap(seed)
    assert auc(lap) == pytest.approx(metrics.roc_auc_score(lap.helped, lap.p_help))
    theirs = metrics.roc_curve(lap.helped, lap.p_help, drop_intermediate=False)
    for ours, other in zip(roc_curve(lap.p_help, lap.helped), theirs[:2], strict=True):
        np.testing.assert_allclose(ours, other)


@given(SEEDS)
def test_rmse_is_over_helped_steps_only(seed):
    """The command is judged where there was one to compare it with."""
    lap = random_lap(seed)
    for component in (0, 1):
        theirs = metrics.root_mean_squared_error(
            lap.action[lap.helped, component], lap.mean[lap.helped, component]
        )
        assert rmse(lap, component) == pytest.approx(theirs)


def test_the_table_counts_demonstrations_and_marks_the_test():
    """One row per run and lap; only the last of a run is a test."""
    runs = [tuple(random_lap(10 * run + i, lap=i) for i in (1, 0, 2)) for run in range(2)]
    table = accuracy_table(runs)
    assert table["demonstrations"].tolist() == [0, 1, 2] * 2
    assert table["lap"].tolist() == [1, 0, 2] * 2
    assert table["test"].tolist() == [False, False, True] * 2
    brier = metrics.brier_score_loss(runs[1][1].helped, runs[1][1].p_help)
    assert table.loc[4, "brier"] == pytest.approx(brier)


def test_a_lap_without_help_has_no_auc():
    """Nothing to tell apart: missing, and left out of the median."""
    lap = random_lap(0)
    lap.helped[:] = False
    assert np.isnan(auc(lap))
    assert np.isnan(rmse(lap, 0))
    assert spread([np.nan, 1.0, 3.0]).n == 2


def test_pooling_keeps_steps_together():
    """p(h) and the demonstrator's signal of each run's lap after n demonstrations."""
    runs = [tuple(random_lap(10 * run + i) for i in range(2)) for run in range(2)]
    p_help, helped = pooled(runs, 1)
    np.testing.assert_array_equal(p_help, np.concatenate([run[1].p_help for run in runs]))
    np.testing.assert_array_equal(helped, np.concatenate([run[1].helped for run in runs]))
