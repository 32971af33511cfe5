"""First and second derivatives of the evidence, against numerical and exact ones."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import log_ndtr
from scipy.stats import norm

from lad.errors import HyperparameterError, InvalidTargetError
from lad.likelihood import (
    check_outputs,
    check_target,
    evidence,
    gaussian_evidence,
    probability_of_help,
    probit_evidence,
)

labels = st.sampled_from([-1.0, 1.0])


def derivatives(f, x, h):
    """First and second central differences of fourth order."""
    a, b, c, d, e = (f(x + i * h) for i in (-2, -1, 0, 1, 2))
    return (a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)


@given(labels, st.floats(-2.0, 2.0), st.floats(0.05, 2.0))
def test_probit_derivatives_are_those_of_the_log_evidence(y, mean, variance):
    """Both are d/dm and d2/dm2 of log Phi(y m / s), by finite differences."""
    first, second = derivatives(lambda m: log_ndtr(y * m / math.sqrt(variance)), mean, 1e-3)
    q, r = probit_evidence(np.array([y]), np.array([mean]), variance)
    assert q[0] == pytest.approx(first, rel=1e-6, abs=1e-8)
    assert r == pytest.approx(second, rel=1e-4, abs=1e-5)


@given(labels, st.floats(-1e9, 1e9), st.floats(1e-9, 1e9))
def test_probit_never_adds_variance_nor_removes_more_than_there_is(y, mean, variance):
    """-1 <= r v <= 0 and q has the label's sign, however wrong the prediction was."""
    q, r = probit_evidence(np.array([y]), np.array([mean]), variance)
    assert -1.0 <= r * variance <= 0.0
    assert np.isfinite(q).all()
    assert q[0] * y >= 0.0


@given(st.floats(-1000.0, -30.0))
def test_probit_far_in_the_wrong_tail(z):
    """The ratio phi / Phi approaches -z + 1 / -z: no cancellation where both underflow."""
    q, _ = probit_evidence(np.array([1.0]), np.array([z]), 1.0)
    assert q[0] == pytest.approx(-z - 1.0 / z + 2.0 / z**3, rel=1e-6)


def test_the_published_second_derivative_is_not_ours():
    """-(z + h^2) / v, as in the reference MATLAB code, is positive at z = -3: variance grows."""
    z = -3.0
    h = norm.pdf(z) / norm.cdf(z)
    _, r = probit_evidence(np.array([1.0]), np.array([z]), 1.0)
    assert r == pytest.approx(-h * (z + h), rel=1e-12)
    assert -(z + h**2) < -1.0 < r < 0.0


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), st.floats(0.01, 5.0))
def test_gaussian_derivatives(y, mean, variance):
    """Both are the derivatives of log N(y | m, v)."""
    q, r = gaussian_evidence(np.array([y]), np.array([mean]), variance)
    first, _ = derivatives(lambda m: norm.logpdf(y, m, math.sqrt(variance)), mean, 1e-3)
    assert q[0] == pytest.approx(first, rel=1e-6, abs=1e-6)
    assert r == -1.0 / variance


def test_evidence_dispatches_by_name():
    """The two likelihoods answer to their names."""
    y, m = np.array([1.0]), np.array([0.2])
    assert evidence(y, m, 0.3, "gaussian") == gaussian_evidence(y, m, 0.3)
    assert evidence(y, m, 0.3, "probit") == probit_evidence(y, m, 0.3)


@pytest.mark.parametrize("label", [0, 2, 0.5, -0.999, [0.0]])
def test_labels_are_minus_one_and_one(label):
    """A classifier refuses every other number, and says what is allowed."""
    with pytest.raises(InvalidTargetError, match=r"allowed are -1 and \+1"):
        check_target(label, 1, "probit")


@pytest.mark.parametrize(
    ("target", "message"),
    [
        (np.nan, "given nan; allowed are finite"),
        ([np.inf], "given inf"),
        ([1e51], "up to 1e\\+50"),
        ([1.0, 2.0], "given shape \\(2,\\); allowed is \\(1,\\)"),
        ("one", "given str"),
        (True, "given bool"),
        (None, "given NoneType"),
    ],
)
def test_bad_targets_are_named(target, message):
    """A target that cannot be learnt says what was given and what is allowed."""
    with pytest.raises(InvalidTargetError, match=message):
        check_target(target, 1, "gaussian")


@pytest.mark.parametrize("target", [1, 1.0, [1], np.array([1.0]), np.float32(1.0)])
def test_a_plain_number_will_do_for_one_output(target):
    """One output takes a number or a vector of one."""
    assert check_target(target, 1, "probit").tolist() == [1.0]


@pytest.mark.parametrize(
    ("likelihood", "n_outputs", "message"),
    [
        ("logit", 1, "given 'logit'; allowed are gaussian and probit"),
        ("probit", 2, "given 2 for probit; allowed is 1"),
        ("gaussian", 0, "given 0 for gaussian; allowed is 1 or more"),
    ],
)
def test_outputs_fit_the_likelihood(likelihood, n_outputs, message):
    """A classifier has one output; an unknown likelihood is refused by name."""
    with pytest.raises(HyperparameterError, match=message):
        check_outputs(likelihood, n_outputs)


@given(st.floats(-3.0, 3.0), st.floats(1e-3, 1.0))
def test_probability_forms(mean, latent):
    """Both forms are Phi of something with the mean's sign; only the default knows the noise."""
    default = probability_of_help(mean, latent, 0.1)
    paper = probability_of_help(mean, latent, 0.1, form="paper")
    assert default == pytest.approx(norm.cdf(mean / math.sqrt(latent + 0.1)), abs=1e-14)
    assert paper == pytest.approx(norm.cdf(mean / latent), abs=1e-14)
    assert (default - 0.5) * mean >= 0.0
    assert (paper - 0.5) * mean >= 0.0
