"""Laplace's evidence against numerical integration, and that tuning moves the right way."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from lad.tuning.classifier import log_evidence, tune_signal_variance


@pytest.mark.parametrize("label", [-1.0, 1.0])
@pytest.mark.parametrize("prior_help", [0.5, 0.35])
def test_one_step_is_an_integral(label, prior_help):
    """With one step p(h) is an integral over f, close to Laplace's value at a modest variance."""
    variance, noise = 0.1, 0.1
    m0 = norm.ppf(prior_help) * np.sqrt(variance + noise)

    def joint(f):
        return norm.cdf(label * f / np.sqrt(noise)) * norm.pdf(f, m0, np.sqrt(variance))

    exact, _ = quad(joint, m0 - 4, m0 + 4)
    found = log_evidence(variance, np.ones((1, 1)), np.array([label]), noise, prior_help)
    assert found == pytest.approx(np.log(exact), abs=0.02)
    assert exact == pytest.approx(prior_help if label > 0 else 1 - prior_help)


def test_no_step_depends_on_another_far_away():
    """Where kappa is the identity, evidence adds up over steps."""
    labels = np.array([1.0, -1.0, 1.0])
    alone = sum(
        log_evidence(0.3, np.ones((1, 1)), np.array([h]), 0.1, 0.5) for h in labels.tolist()
    )
    assert log_evidence(0.3, np.eye(3), labels, 0.1, 0.5) == pytest.approx(alone, abs=1e-6)


def test_clear_labels_ask_for_a_larger_variance_than_mixed_ones():
    """Labels that follow a smooth function raise sigma_f^2 above the start; coin flips do not."""
    x = np.linspace(-3, 3, 80)
    kappa = np.exp(-0.5 * (x[:, None] - x[None, :]) ** 2)
    flips = np.where(np.random.default_rng(0).random(80) < 0.5, -1.0, 1.0)
    clear = tune_signal_variance(0.1, kappa, np.sign(np.sin(2 * x)), 0.1, 0.5)
    mixed = tune_signal_variance(0.1, kappa, flips, 0.1, 0.5)
    assert clear > 0.3 > mixed
