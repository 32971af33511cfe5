"""Inverse of a kernel matrix by pivoted Cholesky factors, in place on the lower triangle.

Written as loops rather than calls of LAPACK because its result depends, in the last digits, on
the number of threads, and the same session must leave the same bytes. Pivoting matters: on
smooth data it leaves |QK - I| hundreds of times smaller than the order of arrival does.
"""

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled, compiled_sums
from lad.triangle import Starts, Vector, row_of


@compiled
def swap(A: Vector, starts: Starts, n: int, i: int, j: int) -> None:
    """Exchange rows and columns i < j of the symmetric matrix of a lower triangle."""
    row_i, row_j = row_of(A, starts, i), row_of(A, starts, j)
    for b in range(i):
        row_i[b], row_j[b] = row_j[b], row_i[b]
    row_i[i], row_j[j] = row_j[j], row_i[i]
    for k in range(i + 1, j):
        row_k = row_of(A, starts, k)
        row_k[i], row_j[k] = row_j[k], row_k[i]
    for k in range(j + 1, n):
        row_k = row_of(A, starts, k)
        row_k[i], row_k[j] = row_k[j], row_k[i]


@compiled_sums
def factorise(K: Vector, starts: Starts, n: int, least_pivot: float) -> NDArray[np.int64]:
    """P K P' = L L': put L where K was, and return which row each step exchanged its own with.

    The pivot is the largest residual variance; at least ``least_pivot`` is used.
    """
    partners = np.empty(n, dtype=np.int64)
    variance = np.empty(n)
    for i in range(n):
        variance[i] = K[starts[i] + i]
    for i in range(n):
        best = i
        for k in range(i + 1, n):
            if variance[k] > variance[best]:
                best = k
        partners[i] = best
        if best > i:
            swap(K, starts, n, i, best)
            variance[best] = variance[i]
        row = row_of(K, starts, i)
        total = row[i]
        for b in range(i):
            total -= row[b] * row[b]
        row[i] = np.sqrt(max(total, least_pivot))
        for k in range(i + 1, n):
            other, total = row_of(K, starts, k), 0.0
            for b in range(i):
                total += other[b] * row[b]
            other[i] = (other[i] - total) / row[i]
            variance[k] -= other[i] * other[i]
    return partners


@compiled
def invert_factor(L: Vector, starts: Starts, n: int) -> None:
    """Put the inverse of L where L was, row by row from the first."""
    inverse_row = np.empty(n)
    for i in range(n):
        row = row_of(L, starts, i)
        inverse_row[:i] = 0.0
        for k in range(i):
            above, weight = row_of(L, starts, k), row[k]
            for b in range(k + 1):
                inverse_row[b] += weight * above[b]
        scale = 1.0 / row[i]
        for b in range(i):
            row[b] = -scale * inverse_row[b]
        row[i] = scale


@compiled
def square_of_factor(X: Vector, starts: Starts, n: int) -> None:
    """Put X' X where X was; row a needs only the rows from a on."""
    product_row = np.empty(n)
    for a in range(n):
        product_row[: a + 1] = 0.0
        for i in range(a, n):
            row = row_of(X, starts, i)
            weight = row[a]
            for b in range(a + 1):
                product_row[b] += weight * row[b]
        row_of(X, starts, a)[:] = product_row[: a + 1]


@compiled
def invert(K: Vector, starts: Starts, n: int, least_pivot: float) -> None:
    """Put the inverse of the positive definite K where K was.

    Parameters
    ----------
    K
        Lower triangle (``lad.triangle``); the first n rows are read and written.
    starts
        Where its rows begin.
    n
        Size of the matrix.
    least_pivot
        Positive; keeps a numerically singular K from producing infinities.
    """
    partners = factorise(K, starts, n, least_pivot)
    invert_factor(K, starts, n)
    square_of_factor(K, starts, n)
    for i in range(n - 1, -1, -1):
        if partners[i] > i:
            swap(K, starts, n, i, partners[i])
