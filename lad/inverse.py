"""Inverse of a kernel matrix by pivoted Cholesky factors, in place on the lower triangle.

Written as loops rather than calls of LAPACK because its result depends, in the last digits, on
the number of threads, and the same session must leave the same bytes. Pivoting matters: on
smooth data it leaves |QK - I| hundreds of times smaller than the order of arrival does.
"""

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled, compiled_sums

Matrix = NDArray[np.float64]


@compiled
def swap(A: Matrix, n: int, i: int, j: int) -> None:
    """Exchange rows and columns i < j of the symmetric matrix of a lower triangle."""
    for b in range(i):
        A[i, b], A[j, b] = A[j, b], A[i, b]
    A[i, i], A[j, j] = A[j, j], A[i, i]
    for k in range(i + 1, j):
        A[k, i], A[j, k] = A[j, k], A[k, i]
    for k in range(j + 1, n):
        A[k, i], A[k, j] = A[k, j], A[k, i]


@compiled_sums
def factorise(K: Matrix, n: int, least_pivot: float) -> NDArray[np.int64]:
    """P K P' = L L': put L where K was, and return which row each step exchanged its own with.

    The pivot is the largest residual variance; below ``least_pivot`` it counts as that.
    """
    partners = np.empty(n, dtype=np.int64)
    variance = np.empty(n)
    for i in range(n):
        variance[i] = K[i, i]
    for i in range(n):
        best = i
        for k in range(i + 1, n):
            if variance[k] > variance[best]:
                best = k
        partners[i] = best
        if best > i:
            swap(K, n, i, best)
            variance[best] = variance[i]
        row = K[i]
        total = row[i]
        for b in range(i):
            total -= row[b] * row[b]
        row[i] = np.sqrt(max(total, least_pivot))
        for k in range(i + 1, n):
            other, total = K[k], 0.0
            for b in range(i):
                total += other[b] * row[b]
            other[i] = (other[i] - total) / row[i]
            variance[k] -= other[i] * other[i]
    return partners


@compiled
def invert_factor(L: Matrix, n: int) -> None:
    """Put the inverse of L where L was, row by row from the first."""
    inverse_row = np.empty(n)
    for i in range(n):
        row = L[i]
        inverse_row[:i] = 0.0
        for k in range(i):
            above, weight = L[k], row[k]
            for b in range(k + 1):
                inverse_row[b] += weight * above[b]
        scale = 1.0 / row[i]
        for b in range(i):
            row[b] = -scale * inverse_row[b]
        row[i] = scale


@compiled
def square_of_factor(X: Matrix, n: int) -> None:
    """Put X' X where X was; row a needs only the rows from a on."""
    product_row = np.empty(n)
    for a in range(n):
        product_row[: a + 1] = 0.0
        for i in range(a, n):
            row, weight = X[i], X[i, a]
            for b in range(a + 1):
                product_row[b] += weight * row[b]
        X[a, : a + 1] = product_row[: a + 1]


@compiled
def invert(K: Matrix, n: int, least_pivot: float) -> None:
    """Put the inverse of the positive definite K where K was.

    Parameters
    ----------
    K
        Shape (room, room); the lower triangle of the first n rows is read and written.
    n
        Size of the matrix.
    least_pivot
        Positive; keeps a numerically singular K from producing infinities.
    """
    partners = factorise(K, n, least_pivot)
    invert_factor(K, n)
    square_of_factor(K, n)
    for i in range(n - 1, -1, -1):
        if partners[i] > i:
            swap(K, n, i, partners[i])
