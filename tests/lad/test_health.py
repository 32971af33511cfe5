"""The watch over |QK - I|: cheap, honest, and it repairs."""

import numpy as np
import pytest

from lad.health import LARGEST_RESIDUAL, LIMIT, Health, KernelMatrix, watch
from lad.hyperparameters import GPHyperparameters
from lad.kernel import recursive_kernel
from lad.stork_gp import StorkGP
from lad.stream import learn_stream


def exact_residual(process):
    """|QK - I| by plain numpy."""
    n = process.n_basis
    basis = process.state.basis[:, :, :n].transpose(2, 0, 1)
    scale = process.hyperparameters.squared_temporal_scale
    K = np.stack([recursive_kernel(basis, b, scale, 0.1) for b in basis])
    return np.abs(process.posterior().Q @ K - np.eye(n)).max()


def test_the_figure_is_what_it_says(stream, make_hyperparameters):
    """The exact figure equals |QK - I| by plain numpy."""
    process = StorkGP(make_hyperparameters(capacity=60), n_outputs=2)
    learn_stream(process, *stream(0, 200, 0.01))
    assert process.residual() == pytest.approx(exact_residual(process), rel=0.2, abs=1e-12)


def test_untrained_has_nothing_to_watch():
    """Without basis vectors the residual is 0."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.1))
    assert process.residual() == 0.0
    assert process.health == Health()


def test_damage_is_noticed_and_repaired(stream, make_hyperparameters):
    """A wrong entry in Q is found by the watch, Q is recomputed, and the repair is counted."""
    process = StorkGP(make_hyperparameters(), n_outputs=2)
    x, y = stream(0, 300, 0.05)
    learn_stream(process, x[:200], y[:200])
    repairs = process.health.repairs
    process.state.Q += 1e-3
    assert exact_residual(process) > 1e-4
    learn_stream(process, x[200:], y[200:])
    assert process.health.repairs > repairs
    assert process.residual() < LARGEST_RESIDUAL


def test_a_sound_process_is_left_alone(stream, make_hyperparameters):
    """With centimetres of lidar noise nothing needs repair, and the watch looks now and then."""
    process = StorkGP(make_hyperparameters(capacity=80), n_outputs=2)
    learn_stream(process, *stream(1, 1000, 0.05))
    assert process.health.repairs == 0
    assert process.health.probes > 10
    assert process.residual() < LARGEST_RESIDUAL


def test_smooth_data_stay_within_bounds():
    """On a noise-free stream, where the inverse drifts to 1e-2 by itself, the watch keeps 1e-6."""
    t = np.arange(1500)[:, None] * 0.02
    x = np.hstack([np.sin(t), np.cos(0.7 * t), np.sin(0.3 * t + 1.0)])
    y = np.sin(2.0 * t)
    hyper = GPHyperparameters(lengthscales=[1.0] * 3, noise_variance=0.01, capacity=40)
    process = StorkGP(hyper)
    unwatched = StorkGP(hyper)
    unwatched.health.risk = -np.inf
    worst = unwatched_worst = 0.0
    for step in range(0, len(x), 25):
        learn_stream(process, x[step : step + 25], y[step : step + 25])
        learn_stream(unwatched, x[step : step + 25], y[step : step + 25])
        worst = max(worst, process.residual())
        unwatched_worst = max(unwatched_worst, unwatched.residual())
    assert unwatched.health.probes == 0
    assert process.health.repairs > 0
    assert worst < LARGEST_RESIDUAL < unwatched_worst / 100.0


@pytest.mark.parametrize("capacity", [50, 200])
def test_noise_free_lidar_stays_within_bounds(stream, make_hyperparameters, capacity):
    """After every step, while the basis fills and when it is full, no entry leaves 1e-6."""
    process = StorkGP(make_hyperparameters(capacity=capacity), n_outputs=2)
    x, y = stream(2, 400, 0.0)
    worst = 0.0
    for step in range(len(x)):
        process.observe(x[step])
        process.learn(y[step])
        worst = max(worst, process.residual())
    assert process.health.repairs > 0
    assert worst < LARGEST_RESIDUAL


def test_what_float64_cannot_repair_is_not_repaired_for_ever():
    """Two equal basis vectors have no inverse: one try, then the limit is what can be reached."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.1))
    learn_stream(process, np.array([[0.0], [1.0], [2.0]]), np.ones((3, 1)))
    process.state.basis[:, :, 1] = process.state.basis[:, :, 0]
    matrix = KernelMatrix(process.state, 1.0 / 1.21, 0.1)
    health = Health()
    for _ in range(5):
        watch(health, matrix, new=2, novelty=1e-9)
    assert health.limit > LIMIT
    assert (health.probes, health.repairs) == (5, 1)
    assert np.isfinite(process.state.Q).all()


def test_risk_decides_when_to_look():
    """Sixteen novel samples, or one that is hardly novel, make it look."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.1))
    process.observe([1.0])
    process.learn(1.0)
    matrix = KernelMatrix(process.state, 1.0 / 1.21, 0.1)
    health = Health()
    for step in range(16):
        assert health.probes == 0, step
        watch(health, matrix, new=0, novelty=0.5)
    assert health.probes == 1
    watch(health, matrix, new=0, novelty=1e-4)
    assert health.probes == 2
    assert health.residual < LIMIT


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.05, 0.004, 0.0])
def test_a_hundred_thousand_steps(stream, make_hyperparameters, noise):
    """Noisy, quiet and noise-free streams stay finite and bounded for 100,000 steps."""
    process = StorkGP(make_hyperparameters(capacity=50), n_outputs=2)
    x, y = stream(2, 100_000, noise)
    learning = learn_stream(process, x, y)
    predictions = learning.predictions
    assert np.isfinite(predictions.mean).all()
    assert (predictions.latent_variance > 0.0).all()
    assert (predictions.latent_variance <= 0.1 * (1.0 + 1e-6)).all()
    assert np.abs(predictions.mean).max() < 10.0
    assert learning.n_basis.max() <= 50
    assert np.isfinite(process.state.C).all()
    assert process.residual() < LARGEST_RESIDUAL


@pytest.mark.slow
def test_a_hundred_thousand_labels(stream, make_hyperparameters):
    """The classifier too, with a tenth of the labels wrong."""
    rng = np.random.default_rng(0)
    process = StorkGP(make_hyperparameters(capacity=50, noise_variance=0.1), "probit")
    x, y = stream(3, 100_000, 0.01)
    labels = np.where((y[:, 1] < -0.3) ^ (rng.uniform(size=len(y)) < 0.1), 1.0, -1.0)
    predictions = learn_stream(process, x, labels[:, None]).predictions
    assert np.isfinite(predictions.mean).all()
    assert (predictions.latent_variance > 0.0).all()
    assert (predictions.latent_variance <= 0.1 * (1.0 + 1e-6)).all()
    assert np.abs(predictions.mean).max() < 100.0
