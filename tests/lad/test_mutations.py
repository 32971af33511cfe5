"""Ten plausible mis-readings of the paper: the reference vectors tell each from the right one."""

import json

import numpy as np
import pytest

from lad import plain
from lad.hyperparameters import GPHyperparameters
from lad.likelihood import evidence
from lad.plain import PlainStorkGP
from lad.posterior import Posterior
from lad.stork_gp import StorkGP
from lad.update import SMALLEST_VARIANCE

LEAST_EFFECT = 6e-3
SETS = [("A_sine_cap50", ""), ("B_wheelchair", "cap100_")]


@pytest.fixture(name="references", scope="module")
def _references(vectors):
    """Hyperparameters, inputs, targets and reference means of the two sets with most deletions."""
    found = []
    for name, prefix in SETS:
        hyper = json.loads((vectors / f"{name}.json").read_text())["hyper"]
        paper = hyper[prefix.rstrip("_")]["paper"] if prefix else hyper["paper"]
        values = {
            "lengthscales": paper["lengthscales"],
            "noise_variance": paper["noise_variance"],
            "capacity": paper["capacity"],
            "recursion_depth": paper["tau"],
            "temporal_scale": paper["sigma_rho"],
            "signal_variance": paper["signal_variance"],
            "novelty": paper["novelty_threshold"],
        }
        with np.load(vectors / f"{name}.npz") as archive:
            found.append((values, archive["X"], archive["Y"], archive[f"{prefix}mean"]))
    return found


def effect(references, model=PlainStorkGP, change=lambda _: {}):
    """Largest difference of a predictive mean from the reference, until it is large enough."""
    largest = 0.0
    for values, X, Y, wanted in references:
        process = model(GPHyperparameters(**(values | change(values))), n_outputs=Y.shape[1])
        for x, y, mean in zip(X, Y, wanted, strict=True):
            process.observe(x)
            largest = max(largest, np.abs(process.predict().mean - mean).max())
            if not largest <= LEAST_EFFECT:
                return largest
            process.learn(y)
    return largest


@pytest.mark.parametrize("model", [PlainStorkGP, StorkGP])
def test_unchanged(references, model):
    """With nothing changed there is no effect: the mutants below change what they say only."""
    assert effect(references, model) < 1e-6


def lengthscales_without_half(values):
    """Make exp(-|a - b|^2 / 2) into exp(-|a - b|^2)."""
    return {"lengthscales": tuple(np.array(values["lengthscales"]) / np.sqrt(2.0))}


@pytest.mark.parametrize("model", [PlainStorkGP, StorkGP])
@pytest.mark.parametrize(
    "change",
    [
        pytest.param(lambda _: {"temporal_scale": np.sqrt(1.1)}, id="rho unsquared"),
        pytest.param(lambda v: {"novelty": v["novelty"] / 0.1}, id="absolute novelty"),
        pytest.param(lambda _: {"recursion_depth": 3}, id="tau one less"),
        pytest.param(lambda _: {"recursion_depth": 5}, id="tau one more"),
        pytest.param(lengthscales_without_half, id="missing half"),
    ],
)
def test_misread_hyperparameters(references, model, change):
    """Mis-readings that hyperparameters can express, in both forms of the model."""
    assert effect(references, model, change) > LEAST_EFFECT


def kernel_mutant(reverse=False, first=1.0, inside=False):
    """Build a kernel that is wrong in one way."""

    def kernel(a, b, squared_temporal_scale, signal_variance, constant_variance=0.0):
        squared = ((a - b) ** 2).sum(axis=-1)
        kappa = np.full(squared.shape[:-1], first)
        lags = range(b.shape[0])
        for lag in lags if reverse else reversed(lags):
            kappa = np.exp(-0.5 * squared[..., lag] + (kappa - 1.0) / squared_temporal_scale)
            kappa = signal_variance * kappa if inside else kappa
        return (kappa if inside else signal_variance * kappa) + constant_variance

    return kernel


@pytest.mark.parametrize(
    "mutant",
    [
        pytest.param({"reverse": True}, id="reversed window"),
        pytest.param({"inside": True}, id="signal variance inside the recursion"),
        pytest.param({"first": 0.0}, id="kappa starts at 0"),
    ],
)
def test_misread_kernel(references, monkeypatch, mutant):
    """Mis-readings of equation (7)."""
    monkeypatch.setattr(plain, "recursive_kernel", kernel_mutant())
    assert effect(references) < 1e-6
    monkeypatch.setattr(plain, "recursive_kernel", kernel_mutant(**mutant))
    assert effect(references) > LEAST_EFFECT


def test_noise_left_out(references, monkeypatch):
    """Learning with the latent variance instead of that of the observation."""

    def without_noise(y, mean, variance, likelihood):
        return evidence(y, mean, max(variance - 0.01, SMALLEST_VARIANCE), likelihood)

    monkeypatch.setattr(plain, "evidence", without_noise)
    assert effect(references) > LEAST_EFFECT


def test_start_padded_with_the_first_input(references):
    """Repeating the first input, where zeros stand for what was not seen."""

    class Padded(PlainStorkGP):
        def observe(self, x):
            missing = 0 if self.window.seen else self.window.depth - 1
            super().observe(x)
            if missing:
                self.window.scaled[1:] = self.window.scaled[0]

    assert effect(references, Padded) > LEAST_EFFECT


@pytest.mark.parametrize(
    "scores",
    [
        pytest.param(lambda s: np.arange(len(s.alpha)), id="the oldest slot"),
        pytest.param(lambda s: (s.alpha**2).sum(axis=1), id="the smallest alpha"),
        pytest.param(lambda s: (s.alpha**2).sum(axis=1) / np.diag(s.Q), id="C left out"),
        pytest.param(lambda s: 1.0 / np.diag(s.Q), id="the least novel"),
    ],
)
def test_other_deletion_rules(references, monkeypatch, scores):
    """Deleting by anything but |alpha|^2 / (Q + C)."""
    monkeypatch.setattr(plain, "deletion_scores", scores)
    assert effect(references) > LEAST_EFFECT


def test_new_vector_spared_from_deletion(references, monkeypatch):
    """Never deleting the vector that has just come."""

    def spared(state: Posterior):
        right = (state.alpha**2).sum(axis=1) / (np.diag(state.Q) + np.diag(state.C))
        return np.append(right[:-1], np.inf)

    monkeypatch.setattr(plain, "deletion_scores", spared)
    assert effect(references) > LEAST_EFFECT
