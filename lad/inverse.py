"""Inverse of a kernel matrix by Cholesky factors, in place on the lower triangle.

Written as loops rather than calls of LAPACK because its result depends, in the last digits, on
the number of threads, and the same session must leave the same bytes.
"""

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled, compiled_sums

Matrix = NDArray[np.float64]


@compiled_sums
def factorise(K: Matrix, n: int, least_pivot: float) -> None:
    """K = L L': put L where K was. A pivot below ``least_pivot`` counts as that."""
    for i in range(n):
        row = K[i]
        for j in range(i):
            other, total = K[j], 0.0
            for b in range(j):
                total += row[b] * other[b]
            row[j] = (row[j] - total) / other[j]
        total = 0.0
        for b in range(i):
            total += row[b] * row[b]
        row[i] = np.sqrt(max(row[i] - total, least_pivot))


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
    factorise(K, n, least_pivot)
    invert_factor(K, n)
    square_of_factor(K, n)
