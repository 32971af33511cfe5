"""The batch form is the steps, to the last bit, and refuses a bad stream before it begins."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lad.errors import InvalidInputError, InvalidTargetError
from lad.hyperparameters import GPHyperparameters
from lad.stork_gp import StorkGP
from lad.stream import learn_stream, predict_stream

HYPER = GPHyperparameters(lengthscales=[1.0, 0.5], noise_variance=0.05, capacity=8)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
def test_same_computation_as_step_by_step(seed, steps):
    """Predictions, events and the model's bytes agree exactly with observe, predict, learn."""
    rng = np.random.default_rng(seed)
    x, y = rng.normal(size=(steps, 2)), rng.normal(size=(steps, 2))
    batch, single = StorkGP(HYPER, n_outputs=2), StorkGP(HYPER, n_outputs=2)
    learning = learn_stream(batch, x, y)
    for t in range(steps):
        single.observe(x[t])
        found = single.predict()
        update = single.learn(y[t])
        assert learning.predictions.mean[t].tolist() == found.mean.tolist()
        assert learning.predictions.variance[t] == found.variance
        assert learning.predictions.latent_variance[t] == found.latent_variance
        assert learning.kind[t] == update.kind
        assert learning.novelty[t] == update.novelty
        assert learning.n_basis[t] == single.n_basis
    assert batch.to_bytes() == single.to_bytes()


def test_predicting_a_stream_learns_nothing():
    """Only the window moves."""
    rng = np.random.default_rng(0)
    process = StorkGP(HYPER)
    learn_stream(process, rng.normal(size=(20, 2)), rng.normal(size=(20, 1)))
    C = process.state.C.copy()
    found = predict_stream(process, rng.normal(size=(5, 2)))
    assert found.mean.shape == (5, 1)
    assert found.variance.tolist() == (found.latent_variance + 0.05).tolist()
    assert np.array_equal(process.state.C, C)
    assert process.window.time == 24


@pytest.mark.parametrize(
    ("x", "y", "error", "message"),
    [
        (np.zeros((3, 2)), np.zeros((2, 1)), InvalidTargetError, "given 2 rows; allowed are 3"),
        (np.zeros(3), np.zeros((3, 1)), InvalidInputError, "X: given shape"),
        (np.zeros((3, 2)), np.zeros(3), InvalidTargetError, "Y: given shape"),
        (np.zeros((3, 5)), np.zeros((3, 1)), InvalidInputError, "step 0: input: given shape"),
        (
            np.array([[0.0, 0.0], [0.0, np.nan]]),
            np.zeros((2, 1)),
            InvalidInputError,
            "step 1: input: given nan at index 1",
        ),
        (
            np.zeros((2, 2)),
            np.array([[0.0], [np.inf]]),
            InvalidTargetError,
            "step 1: target: given inf",
        ),
    ],
)
def test_a_bad_stream_changes_nothing(x, y, error, message):
    """One bad value anywhere and not even the first step is taken."""
    process = StorkGP(HYPER)
    before = process.to_bytes()
    with pytest.raises(error, match=message):
        learn_stream(process, x, y)
    assert process.to_bytes() == before
