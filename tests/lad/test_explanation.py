"""Which basis vectors a prediction leans on."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from lad.explanation import explain, shared
from lad.hyperparameters import GPHyperparameters
from lad.stork_gp import StorkGP
from lad.stream import learn_stream


def trained(seed):
    """Train two outputs over two laps."""
    rng = np.random.default_rng(seed)
    process = StorkGP(
        GPHyperparameters(lengthscales=[2.0, 0.5], noise_variance=0.01, capacity=15), n_outputs=2
    )
    for _ in range(2):
        learn_stream(process, rng.normal(size=(12, 2)), rng.normal(size=(12, 2)))
        process.reset_window()
    process.observe(rng.normal(size=2))
    return process


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_contributions_add_up_to_the_mean(seed):
    """Over all basis vectors, strongest first, contributions sum to the prediction."""
    process = trained(seed)
    everything = explain(process, most=None)
    assert len(everything) == process.n_basis
    total = sum(one.contribution for one in everything)
    assert np.abs(total - process.predict().mean).max() < 1e-12
    strength = [np.linalg.norm(one.contribution) for one in everything]
    assert strength == sorted(strength, reverse=True)
    assert all(0.0 <= one.likeness <= 1.0 for one in everything)
    assert {one.time for one in everything} == set(process.times.tolist())


def test_it_names_when_and_what_was_seen():
    """A window seen before leans on itself: its time, its lap, its inputs in their own units."""
    process = StorkGP(GPHyperparameters(lengthscales=[2.0, 0.5], noise_variance=0.01))
    for x, y in (([1.0, 2.0], 0.0), ([3.0, 4.0], 1.0)):
        process.reset_window()
        process.observe(x)
        process.learn(y)
    (first,) = explain(process, most=1)
    assert (first.time, first.lap) == (1, 1)
    assert first.inputs.tolist() == [[3.0, 4.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]]
    assert first.likeness == 1.0


def test_nothing_learnt_nothing_to_explain():
    """An untrained process leans on nothing."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.01))
    process.observe([1.0])
    assert explain(process) == []


def test_explaining_changes_nothing():
    """The model's bytes are the same before and after."""
    process = trained(0)
    before = process.to_bytes()
    explain(process)
    assert process.to_bytes() == before


def test_contributions_and_what_is_shared_add_up_to_the_mean():
    """With a constant and a prior mean, too: local parts, and the part that no input changes."""
    rng = np.random.default_rng(5)
    hyper = GPHyperparameters(
        lengthscales=[0.5, 1.0], noise_variance=0.01, constant_variance=0.3, prior_mean=0.2
    )
    process = StorkGP(hyper, n_outputs=2)
    for x in rng.normal(size=(30, 2)):
        process.observe(x)
        process.learn(x + 1.0)
    local = np.sum([one.contribution for one in explain(process, most=None)], axis=0)
    assert np.allclose(local + shared(process), process.predict().mean, atol=1e-9)
