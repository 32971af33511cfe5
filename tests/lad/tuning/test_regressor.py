"""The evidence against other ways to compute it, its gradient, and what maximising finds."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import approx_fprime
from scipy.stats import multivariate_normal

from lad.kernel import recursive_kernel
from lad.tuning.distances import Distances
from lad.tuning.regressor import LEAST_NOISE, Chosen, log_evidence, tune_regressor

GROUPS = (slice(0, 1), slice(1, 3))
RHO = 1.21


def problem(seed, n=30, p=2):
    """Windows (n, 3, 3) and targets (n, p)."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, 3, 3)), rng.normal(size=(n, p))


def dense_kernel(windows, chosen):
    """K by the definition's kernel, one row at a time."""
    scales = np.array([chosen.lengthscales[0], *[chosen.lengthscales[1]] * 2])
    scaled = windows / scales
    rows = [
        recursive_kernel(scaled, w, RHO, chosen.signal_variance, chosen.constant_variance)
        for w in scaled
    ]
    return np.array(rows) + chosen.noise * np.eye(len(windows))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.2]))
def test_evidence_is_the_density_of_the_targets(seed, constant):
    """Equal to scipy's multivariate normal with the definition's kernel, summed over outputs."""
    windows, targets = problem(seed)
    at = Chosen(0.3, 0.05, (0.8, 1.7), constant)
    found, _ = log_evidence(at.logs(), Distances.of(windows, GROUPS), targets, RHO)
    dense = multivariate_normal(np.zeros(len(windows)), dense_kernel(windows, at))
    assert found == pytest.approx(sum(dense.logpdf(targets[:, i]) for i in range(2)), rel=1e-9)


@pytest.mark.parametrize("constant", [0.0, 0.2])
def test_gradient_is_the_slope(constant):
    """Every component equals a finite difference."""
    windows, targets = problem(1)
    distances = Distances.of(windows, GROUPS)
    at = Chosen(0.3, 0.05, (0.8, 1.7), constant).logs()
    _, gradient = log_evidence(at, distances, targets, RHO)
    slope = approx_fprime(at, lambda x: log_evidence(x, distances, targets, RHO)[0], 1e-6)
    assert np.abs(gradient - slope).max() < 1e-3 * np.abs(slope).max()


def test_tuning_finds_what_the_targets_were_drawn_from():
    """Noise and signal of a sample are recovered within a factor, from a start ten times off."""
    rng = np.random.default_rng(3)
    windows = rng.uniform(-2, 2, size=(200, 1, 3))
    truth = Chosen(0.5, 0.02, (1.0, 1.5), 0.0)
    targets = rng.multivariate_normal(np.zeros(200), dense_kernel(windows, truth), size=2).T
    start = Chosen(0.1, 0.2, (0.4, 1.5), 0.0)
    found = tune_regressor(start, Distances.of(windows, GROUPS), targets, RHO)
    assert 0.5 < found.noise / truth.noise < 2.0
    assert 0.3 < found.signal_variance / truth.signal_variance < 3.0
    assert 0.6 < found.lengthscales[0] / truth.lengthscales[0] < 1.6
    assert found.constant_variance == 0.0


def test_noise_stays_above_its_floor():
    """Targets without any noise do not make K singular."""
    windows, _ = problem(4, n=40)
    targets = np.full((40, 2), 0.3)
    found = tune_regressor(
        Chosen(0.1, 0.01, (1.0, 1.0), 0.1), Distances.of(windows, GROUPS), targets, RHO
    )
    assert found.noise >= LEAST_NOISE
