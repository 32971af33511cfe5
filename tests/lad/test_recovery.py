"""An impossible posterior is rebuilt, and only an impossible one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lad.health import KernelMatrix
from lad.hyperparameters import GPHyperparameters
from lad.recovery import is_possible, rebuild
from lad.stork_gp import StorkGP
from lad.stream import learn_stream


def test_rebuilding_is_one_observation_per_vector():
    """The rebuilt process is an exact GP that saw each basis vector once, at the old mean there."""
    rng = np.random.default_rng(0)
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=0.05, recursion_depth=1)
    process = StorkGP(hyper)
    x = np.linspace(-2.0, 2.0, 9)[:, None]
    learn_stream(process, x, rng.normal(size=(9, 1)))
    n = process.n_basis
    at = process.state.basis[0, 0, :n].copy()
    K = 0.1 * np.exp(-0.5 * (at[:, None] - at) ** 2)
    held = K @ process.state.alpha[0, :n]
    rebuild(KernelMatrix(process.state, 1.0 / 1.21, 0.1), 0.05)
    process.observe([0.3])
    found = process.predict()
    k = 0.1 * np.exp(-0.5 * (at - 0.3) ** 2)
    weights = np.linalg.solve(K + 0.05 * np.eye(n), k)
    assert found.mean[0] == pytest.approx(weights @ held, abs=1e-12)
    assert found.latent_variance == pytest.approx(0.1 - weights @ k, abs=1e-12)


def test_what_is_not_finite_is_forgotten():
    """Even from infinities there is a way back: that output starts again at 0."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.05), n_outputs=2)
    learn_stream(process, np.array([[0.0], [2.0]]), np.array([[1.0, 2.0], [3.0, 4.0]]))
    process.state.alpha[0, 0] = np.inf
    process.state.C[process.state.starts[1]] = np.nan
    process.observe([1.0])
    process.learn([0.0, 0.0])
    found = process.predict()
    assert process.health.recoveries == 1
    assert np.isfinite(found.mean).all()
    assert 0.0 < found.latent_variance < 0.1
    assert found.mean[1] > 0.0


@settings(max_examples=20, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    noise=st.sampled_from([1e-9, 1e-6, 1e-3]),
    novelty=st.sampled_from([1e-12, 1e-8, 1e-5]),
    spread=st.sampled_from([1e-4, 1e-2, 0.1]),
)
def test_hardly_any_noise_on_inputs_hardly_apart(seed, noise, novelty, spread):
    """Where the recursion alone ends in NaN, predictions stay finite and variances positive."""
    rng = np.random.default_rng(seed)
    process = StorkGP(
        GPHyperparameters(lengthscales=[1.0], noise_variance=noise, capacity=12, novelty=novelty)
    )
    x, y = spread * rng.normal(size=(300, 1)), rng.uniform(-1.0, 1.0, size=(300, 1))
    predictions = learn_stream(process, x, y).predictions
    assert np.isfinite(predictions.mean).all()
    assert (predictions.latent_variance > 0.0).all()


def test_it_is_needed_there():
    """Without the way back that stream does end in NaN: the test above can fail."""
    rng = np.random.default_rng(1)
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=1e-9, capacity=10, novelty=1e-12)

    class Unguarded(StorkGP):
        def _recover(self):
            pass

    x, y = 1e-3 * rng.normal(size=(300, 1)), rng.uniform(-1.0, 1.0, size=(300, 1))
    with np.errstate(all="ignore"):
        lost = learn_stream(Unguarded(hyper), x, y).predictions
    assert not np.isfinite(lost.mean).all()


def test_table_one_never_needs_it(stream, make_hyperparameters):
    """With the paper's noise no posterior is impossible, on quiet or noise-free lidar."""
    for noise in (0.0, 0.004):
        process = StorkGP(make_hyperparameters(capacity=80), n_outputs=2)
        learn_stream(process, *stream(0, 1500, noise))
        assert process.health.recoveries == 0


@pytest.mark.parametrize(
    ("latent", "possible"), [(0.05, True), (-1e-4, True), (-2e-3, False), (np.nan, False)]
)
def test_what_is_possible(latent, possible):
    """A variance a little below 0 is rounding; far below, or none at all, is not."""
    assert is_possible(latent, noise=0.01) is possible
