"""The definition itself, against a batch exact GP and dense assumed-density filtering."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import cho_factor, cho_solve
from scipy.stats import norm

from lad.errors import InvalidInputError, InvalidTargetError
from lad.hyperparameters import GPHyperparameters
from lad.plain import PlainStorkGP, without
from lad.stork_gp import StorkGP
from lad.update import UpdateKind

BOTH = pytest.mark.parametrize("model", [PlainStorkGP, StorkGP])


def kernel_by_hand(a, b, tau, constant=0.0):
    """Equation (7) with loops, from the paper's text alone; a and b are lists, newest first."""
    kappa = 1.0
    for lag in reversed(range(tau)):
        squared = sum((x - z) ** 2 for x, z in zip(a[lag], b[lag], strict=True))
        kappa = math.exp(-0.5 * squared) * math.exp((kappa - 1.0) / 1.1**2)
    return 0.1 * kappa + constant


def windows_of(x, tau):
    """Every window of a stream, zeros before its start, inputs already over lengthscales."""
    padded = np.vstack([np.zeros((tau - 1, x.shape[1])), x])
    return [padded[t : t + tau][::-1].tolist() for t in range(len(x))]


def gram(windows, tau, constant=0.0):
    """Kernel matrix of all windows."""
    return np.array([[kernel_by_hand(a, b, tau, constant) for a in windows] for b in windows])


@BOTH
@pytest.mark.parametrize(
    ("tau", "constant", "m0"), [(1, 0, 0), (4, 0, 0), (4, 0.1, 0), (4, 2, 0.3)]
)
def test_full_updates_equal_a_batch_exact_gp(model, tau, constant, m0):
    """Where every update was full, mean and variance equal a Cholesky solve's to 1e-10.

    Also with a constant in the kernel and a prior mean.
    """
    rng = np.random.default_rng(tau)
    x, y = rng.normal(size=(70, 3)), rng.normal(size=(70, 2))
    hyper = GPHyperparameters(
        lengthscales=[0.8, 1.0, 1.3],
        noise_variance=0.01,
        recursion_depth=tau,
        novelty=1e-9,
        constant_variance=constant,
        prior_mean=m0,
    )
    process = model(hyper, n_outputs=2)
    K = gram(windows_of(x / np.array([0.8, 1.0, 1.3]), tau), tau, constant)
    for t in range(60):
        process.observe(x[t])
        assert process.learn(y[t]).kind != UpdateKind.SPARSE
    factor = cho_factor(K[:60, :60] + 0.01 * np.eye(60))
    for t in range(60, 70):
        process.observe(x[t])
        found = process.predict()
        k = K[t, :60]
        wanted = m0 + k @ cho_solve(factor, y[:60] - m0)
        assert np.abs(found.mean - wanted).max() < 1e-10
        prior = 0.1 + constant
        assert abs(found.latent_variance - (prior - k @ cho_solve(factor, k))) < 1e-10
        assert found.variance == found.latent_variance + 0.01


@BOTH
def test_probit_equals_dense_assumed_density_filtering(model):
    """Without deletion the classifier is assumed-density filtering on the full joint Gaussian."""
    rng = np.random.default_rng(3)
    x = rng.normal(size=(60, 2))
    y = np.where(x[:, 0] + 0.3 * rng.normal(size=60) > 0.0, 1.0, -1.0)
    hyper = GPHyperparameters(lengthscales=[1.0, 1.0], noise_variance=0.1, novelty=1e-9)
    process = model(hyper, "probit")
    mean, cov = np.zeros(60), gram(windows_of(x, 4), 4)
    for t in range(60):
        process.observe(x[t])
        found = process.predict()
        assert abs(found.mean[0] - mean[t]) < 1e-10
        assert abs(found.latent_variance - cov[t, t]) < 1e-10
        assert process.learn(y[t]).kind != UpdateKind.SPARSE
        s = math.sqrt(cov[t, t] + 0.1)
        z = y[t] * mean[t] / s
        ratio = math.exp(norm.logpdf(z) - norm.logcdf(z))
        column = cov[:, t].copy()
        mean += column * (y[t] * ratio / s)
        cov -= np.outer(column, column) * (ratio * (z + ratio) / s**2)


def test_deletion_is_the_projection_that_forgets_one_vector():
    """After a deletion the process agrees with the one before it wherever k has no i-th part.

    The reduced process lives on the remaining vectors b: its mean at them changes by what the
    removed coefficient explained beyond them, and Q is the inverse of their kernel matrix.
    """
    rng = np.random.default_rng(5)
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=0.01, capacity=8, novelty=1e-6)
    process = PlainStorkGP(hyper)
    for t, (x, y) in enumerate(rng.normal(size=(40, 2))):
        process.observe([x])
        update = process.learn(y)
        K = np.stack([process_kernel(process, b) for b in process.basis])
        assert np.abs(process.state.Q @ K - np.eye(len(K))).max() < 1e-6
        if update.kind == UpdateKind.FULL_THEN_DELETION:
            assert update.deleted_time not in process.times
            assert update.deleted_time <= t
    assert len(process.basis) == 8


def process_kernel(process, window):
    """Covariance of a stored window with every basis vector."""
    return np.array([kernel_by_hand(b.tolist(), window.tolist(), 4) for b in process.basis])


def test_the_last_takes_the_place_of_the_deleted():
    """Slots are replaced, not shifted, as in the fused form."""
    assert without(1, 4).tolist() == [0, 3, 2]
    assert without(3, 4).tolist() == [0, 1, 2]


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(1, 6))
def test_prior_before_anything_is_learnt(seed, outputs):
    """An untrained process predicts the prior: mean 0, variance sigma_f^2 and noise."""
    x = np.random.default_rng(seed).normal(size=2)
    for model in (PlainStorkGP, StorkGP):
        process = model(
            GPHyperparameters(lengthscales=[1.0, 2.0], noise_variance=0.05), n_outputs=outputs
        )
        process.observe(x)
        found = process.predict()
        assert found.mean.tolist() == [0.0] * outputs
        assert found.latent_variance == 0.1
        assert found.variance == 0.1 + 0.05


@BOTH
@pytest.mark.parametrize("bad", [[np.nan], [np.inf], [1.0, 2.0], "x", None])
def test_bad_input_raises_and_changes_nothing(model, bad):
    """One bad sample cannot spoil a model, as it does the reference library for good."""
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=0.1)
    process = model(hyper)
    process.observe([0.3])
    process.learn([1.0])
    before = process.predict()
    with pytest.raises(InvalidInputError):
        process.observe(bad)
    with pytest.raises(InvalidTargetError):
        process.learn(bad)
    after = process.predict()
    assert after.mean == before.mean
    assert after.latent_variance == before.latent_variance
