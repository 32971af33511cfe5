"""Equation (7), against numbers worked out by hand and its own bounds."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from lad.kernel import recursive_kernel

windows = arrays(np.float64, (4, 3), elements=st.floats(-3.0, 3.0))


def test_two_lags_by_hand():
    """The recursion runs from the oldest lag to the newest, starting at kappa = 1."""
    a, b = np.array([[1.0], [3.0]]), np.array([[0.5], [1.0]])
    oldest = math.exp(-0.5 * 4.0) * math.exp(0.0)
    newest = math.exp(-0.5 * 0.25) * math.exp((oldest - 1.0) / 1.21)
    assert math.isclose(recursive_kernel(a, b, 1.21, 0.1), 0.1 * newest, rel_tol=1e-15)


@given(windows, windows)
def test_symmetric_bounded_and_largest_at_itself(a, b):
    """k(a, b) = k(b, a), 0 <= k(a, b) <= k(a, a) = sigma_f^2."""
    one, other = recursive_kernel(a, b, 1.21, 0.1), recursive_kernel(b, a, 1.21, 0.1)
    assert one == other
    assert 0.0 <= one <= 0.1
    assert recursive_kernel(a, a, 1.21, 0.1) == 0.1


@given(windows, windows)
def test_the_past_modulates_within_known_bounds(a, b):
    """The past changes k by a factor between exp(-1 / sigma_rho^2) and 1."""
    whole = recursive_kernel(a, b, 1.21, 1.0)
    now = recursive_kernel(a[:1], b[:1], 1.21, 1.0)
    assert now * math.exp(-1.0 / 1.21) <= whole * (1.0 + 1e-12) + 1e-300
    assert whole <= now * (1.0 + 1e-12) + 1e-300


@given(arrays(np.float64, (6, 4, 3), elements=st.floats(-3.0, 3.0)))
def test_positive_semidefinite(many):
    """A kernel matrix has no negative eigenvalue beyond rounding."""
    K = np.stack([recursive_kernel(many, one, 1.21, 1.0) for one in many])
    assert np.linalg.eigvalsh(K).min() > -1e-12


def test_one_lag_is_the_squared_exponential():
    """With tau = 1 the kernel is the ordinary one."""
    a, b = np.array([[0.3, -0.2]]), np.array([[1.0, 0.4]])
    wanted = 0.7 * math.exp(-0.5 * (0.49 + 0.36))
    assert math.isclose(recursive_kernel(a, b, 1.21, 0.7), wanted, rel_tol=1e-15)
