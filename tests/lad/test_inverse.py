"""The pivoted inverse: exact, in place, and accurate where it matters."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from lad.inverse import invert, swap
from lad.triangle import entries, packed, row_starts, whole


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 25), st.integers(0, 2**32 - 1))
def test_inverse_of_any_positive_definite_matrix(n, seed):
    """Equal to numpy's inverse on well-conditioned matrices; nothing beyond n rows moves."""
    rng = np.random.default_rng(seed)
    factor = rng.normal(size=(n, n))
    K = factor @ factor.T + n * np.eye(n)
    larger = np.full((n + 1, n + 1), np.nan)
    larger[:n, :n] = K
    A = packed(larger)
    padding = np.setdiff1d(np.arange(len(A)), entries(n))
    before = A[padding]
    invert(A, row_starts(n + 1), n, 1e-12)
    assert np.abs(whole(A, n) - np.linalg.inv(K)).max() < 1e-12
    assert np.array_equal(A[padding], before, equal_nan=True)


@given(st.integers(2, 9), st.data())
def test_swap_exchanges_rows_and_columns(n, data):
    """Exchanging i and j in a triangle is exchanging both rows and columns of the matrix."""
    j = data.draw(st.integers(1, n - 1))
    i = data.draw(st.integers(0, j - 1))
    A = packed(np.arange(float(n * n)).reshape(n, n))
    matrix = whole(A, n)
    swap(A, row_starts(n), n, i, j)
    order = np.arange(n)
    order[[i, j]] = order[[j, i]]
    assert np.array_equal(whole(A, n), matrix[np.ix_(order, order)])


def test_residual_on_a_nearly_singular_kernel_matrix():
    """At a condition number near 1e10 |QK - I| stays below 1e-6, where numpy's inverse does not."""
    x = np.linspace(0.0, 6.0, 40)
    K = np.exp(-0.5 * (x[:, None] - x) ** 2 / 0.4**2) + 1e-9 * np.eye(40)
    A = packed(K)
    invert(A, row_starts(40), 40, 1e-12)
    ours = np.abs(whole(A, 40) @ K - np.eye(40)).max()
    theirs = np.abs(np.linalg.inv(K) @ K - np.eye(40)).max()
    assert np.linalg.cond(K) > 5e9
    assert ours < 1e-6 < theirs


def test_a_singular_matrix_gives_finite_numbers():
    """Two equal basis vectors cannot produce infinities."""
    A = packed(np.full((3, 3), 0.1))
    invert(A, row_starts(3), 3, 1e-12)
    assert np.isfinite(A).all()
