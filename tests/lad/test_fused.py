"""Each compiled piece against the line of numpy it stands for."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lad import fused
from lad.compiled import compiled
from lad.kernel import recursive_kernel
from lad.triangle import entries, packed, row_starts, triangle_zeros, whole


@compiled
def _exp_of_all(x, out):
    for i in range(x.size):
        out[i] = fused.exp_of_nonpositive(x[i])


def test_exp_is_exact_to_one_unit_in_the_last_place():
    """On a hundred thousand points, and at the ends, e^x agrees with the library to 1 ulp."""
    x = -np.random.default_rng(0).exponential(10.0, 100_000)
    x = np.concatenate([x[x > -80.0], [0.0, -1e-300, -1e-17, -0.34657359, -0.3465736, -80.0]])
    found = np.empty_like(x)
    _exp_of_all(x, found)
    wanted = np.exp(x)
    assert (np.abs(found - wanted) <= np.spacing(wanted)).all()
    assert found[x == 0.0].tolist() == [1.0]


def test_exp_stays_positive_and_small_below_its_range():
    """Far away, even at minus infinity, the kernel is 2e-35: no subnormal numbers, no zero."""
    x = np.array([-80.0, -80.1, -1e4, -1e308, -np.inf])
    found = np.empty_like(x)
    _exp_of_all(x, found)
    assert (found == found[0]).all()
    assert found[0] == pytest.approx(np.exp(-80.0), rel=1e-15)


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 40), st.integers(1, 7), st.integers(1, 5), st.integers(0, 2**32 - 1))
def test_kernel_vector_is_equation_seven(n, d, tau, seed):
    """For every number of vectors, inputs and lags: blocks of four and what remains."""
    rng = np.random.default_rng(seed)
    basis, window = rng.normal(size=(tau, d, n + 3)), rng.normal(size=(tau, d))
    k = np.full(n + 3, np.nan)
    constant = float(rng.choice([0.0, 0.1]))
    fused.kernel_vector(basis, window, n, 1.0 / 1.21, 0.1, constant, k, np.empty(n + 3))
    wanted = recursive_kernel(basis.transpose(2, 0, 1)[:n], window, 1.21, 0.1, constant)
    assert np.abs(k[:n] - wanted).max() < 1e-15
    assert np.isnan(k[n:]).all()


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 30), st.integers(0, 2**32 - 1))
def test_symmetric_product_reads_n_rows_only(n, seed):
    """Product with the symmetric matrix, whatever stands in the padding or beyond n rows."""
    rng = np.random.default_rng(seed)
    triangle = triangle_zeros(n + 2)
    triangle[:] = np.nan
    triangle[entries(n)] = rng.normal(size=n * (n + 1) // 2)
    x, out = rng.normal(size=n + 2), np.full(n + 2, np.nan)
    fused.symmetric_product(triangle, row_starts(n + 2), x, n, out)
    wanted = whole(triangle, n) @ x[:n]
    assert np.abs(out[:n] - wanted).max(initial=0.0) < 1e-12
    assert np.isnan(out[n:]).all()


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 30), st.integers(0, 2**32 - 1))
def test_add_outer_writes_n_rows_only(n, seed):
    """A rank-one update of a triangle, padding and further rows untouched."""
    rng = np.random.default_rng(seed)
    matrix, x = rng.normal(size=(n + 2, n + 2)), rng.normal(size=n)
    triangle = packed(matrix)
    untouched = np.ones(len(triangle), dtype=bool)
    untouched[entries(n)] = False
    before = triangle.copy()
    fused.add_outer(triangle, row_starts(n + 2), n, -0.3, x)
    wanted = (matrix[:n, :n] - 0.3 * np.outer(x, x))[np.tril_indices(n)]
    assert np.abs(triangle[entries(n)] - wanted).max() < 1e-14
    assert np.array_equal(triangle[untouched], before[untouched])
