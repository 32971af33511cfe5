"""Help without a signal: found in its stretches, not found where there is none."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lad import latent
from lad.errors import InvalidTargetError, TooFewStepsError
from lad.latent import infer_help


def lap(seed, noise, stretches=((60, 100), (200, 250)), steps=400):
    """Differences of one lap with noise, and where help was given."""
    rng = np.random.default_rng(seed)
    d = rng.normal(0.0, noise, (steps, 2))
    helped = np.zeros(steps, dtype=bool)
    for start, stop in stretches:
        helped[start:stop] = True
    n = helped.sum()
    d[helped] += np.column_stack([rng.normal(-0.1, 0.08, n), rng.normal(-0.33, 0.08, n)])
    return d, helped


def area(p, helped):
    """Area under the ROC curve, by counting pairs."""
    return np.mean(p[helped][:, None] > p[~helped][None, :])


@pytest.mark.parametrize(("noise", "least"), [(0.05, 0.999), (0.1, 0.99), (0.2, 0.97)])
def test_help_is_found_at_command_noise(noise, least):
    """Over ten laps the mean area under the ROC curve against the true h is as asked."""
    found = [area(infer_help(d).p_help, h) for d, h in (lap(s, noise) for s in range(10))]
    assert np.mean(found) >= least


def test_the_chain_is_better_than_single_steps():
    """Help comes in stretches: with strong noise neighbours tell more than a step itself."""
    with_chain, without = [], []
    for seed in range(10):
        d, helped = lap(seed, 0.25)
        with_chain.append(area(infer_help(d).p_help, helped))
        without.append(area(-d[:, 1], helped))
    assert np.mean(with_chain) > np.mean(without) + 0.02


def test_without_noise_the_signal_is_recovered_exactly():
    """Where commands are seen exactly, help is where they differ."""
    d, helped = lap(1, 0.0)
    assert ((infer_help(d).p_help > 0.5) == helped).all()


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.02, 0.1, 0.3]))
def test_noise_alone_is_no_help(seed, noise):
    """A lap without help has none, whatever the noise."""
    d, _ = lap(seed, noise, stretches=())
    assert infer_help(d).p_help.max() < 0.5


def test_its_parameters_are_those_of_the_lap():
    """Noise, mean correction and lengths of stretches come out near what was put in."""
    found = infer_help(lap(3, 0.1)[0])
    assert found.noise_sd == pytest.approx((0.1, 0.1), rel=0.15)
    assert found.correction == pytest.approx((-0.1, -0.33), abs=0.05)
    assert min(found.stay) > 0.9


def test_smoothing_is_the_sum_over_all_paths():
    """Forwards and backwards equal brute force over every path of a short chain."""
    rng = np.random.default_rng(0)
    log_emission = rng.normal(size=(6, 2))
    stay, first = np.array([0.8, 0.7]), 0.3
    move = np.array([[0.8, 0.2], [0.3, 0.7]])
    total, on = 0.0, np.zeros(6)
    for path in itertools.product((0, 1), repeat=6):
        weight = (first if path[0] else 1 - first) * np.exp(log_emission[0, path[0]])
        for t in range(1, 6):
            weight *= move[path[t - 1], path[t]] * np.exp(log_emission[t, path[t]])
        total += weight
        on += weight * np.array(path)
    p, _, evidence = latent._smoothed(log_emission, stay, first)
    assert p == pytest.approx(on / total)
    assert evidence == pytest.approx(np.log(total))


@pytest.mark.parametrize(
    ("bad", "error"),
    [
        (np.zeros((19, 2)), TooFewStepsError),
        (np.zeros((30, 3)), InvalidTargetError),
        (np.full((30, 2), np.nan), InvalidTargetError),
    ],
)
def test_bad_input_is_a_named_error(bad, error):
    """Too few steps, another shape, a missing value."""
    with pytest.raises(error):
        infer_help(bad)
