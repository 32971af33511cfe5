"""Triangles laid out row by row."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.triangle import aligned_zeros, entries, packed, row_of, row_starts, triangle_zeros, whole

sizes = st.integers(1, 70)


@pytest.mark.parametrize("shape", [(3, 8), (1, 16), (4, 2, 24)])
def test_arrays_begin_on_a_cache_line(shape):
    """The address of the first number is a multiple of 64 bytes."""
    array = aligned_zeros(*shape)
    assert array.ctypes.data % 64 == 0
    assert array.shape == shape
    assert not array.any()


@given(sizes)
def test_rows_begin_on_cache_lines_and_follow_each_other(n):
    """Each row starts on a line, has room for its entries, and wastes less than a line."""
    starts = row_starts(n + 1)
    lengths = np.diff(starts)
    assert (starts % 8 == 0).all()
    assert (lengths >= np.arange(1, n + 1)).all()
    assert (lengths < np.arange(1, n + 1) + 8).all()
    assert len(triangle_zeros(n)) == starts[n]


@given(sizes, sizes)
def test_a_smaller_triangle_is_the_beginning_of_a_larger(n, m):
    """Growing is copying: the layout does not depend on the size."""
    small, large = sorted((n, m))
    assert np.array_equal(row_starts(large)[:small], row_starts(small))
    assert np.array_equal(entries(large)[: small * (small + 1) // 2], entries(small))


@given(sizes, st.integers(0, 2**32 - 1))
def test_packing_and_unpacking(n, seed):
    """What was packed comes back, and each row is where its start says."""
    matrix = np.random.default_rng(seed).normal(size=(n, n))
    triangle = packed(matrix)
    lower = np.tril(matrix)
    assert np.array_equal(whole(triangle, n), lower + np.tril(matrix, -1).T)
    last = row_of(triangle, row_starts(n), n - 1)
    assert np.array_equal(last, matrix[n - 1])
