"""Lower triangles in one dimension: row after row, each beginning on a cache line.

Half the memory of a square, and half its pages: at 800 vectors two square arrays of which the
triangles are visited touch more pages than the processor's address translation holds, and the
step takes three times as long. The layout of a smaller triangle is the beginning of a larger one's.
"""

import math

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled

Vector = NDArray[np.float64]
Starts = NDArray[np.int64]

LINE = 8
"""Float64 numbers in a cache line."""


def aligned_zeros(*shape: int) -> NDArray[np.float64]:
    """Zeros that begin on a cache line."""
    size = math.prod(shape)
    buffer = np.zeros(size + LINE)
    offset = (-buffer.ctypes.data // buffer.itemsize) % LINE
    return buffer[offset : offset + size].reshape(shape)


def padded(n: int) -> int:
    """Round n up to whole cache lines."""
    return -(-n // LINE) * LINE


def row_starts(n: int) -> Starts:
    """Where each of n rows begins; row a is padded to whole cache lines.

    Examples
    --------
    >>> row_starts(10).tolist()
    [0, 8, 16, 24, 32, 40, 48, 56, 64, 80]
    """
    row = np.arange(n, dtype=np.int64)
    group = row // LINE
    return LINE * (LINE * group * (group + 1) // 2 + row % LINE * (group + 1))


def triangle_zeros(n: int) -> Vector:
    """Room for a triangle of n rows."""
    return aligned_zeros(int(row_starts(n + 1)[n]))


def entries(n: int) -> Starts:
    """Where the n (n + 1) / 2 entries of a triangle are, row by row."""
    rows, columns = np.tril_indices(n)
    return row_starts(n)[rows] + columns


def packed(matrix: NDArray[np.float64]) -> Vector:
    """Lay out the lower triangle of a square matrix."""
    n = len(matrix)
    triangle = triangle_zeros(n)
    triangle[entries(n)] = matrix[np.tril_indices(n)]
    return triangle


def whole(triangle: Vector, n: int) -> NDArray[np.float64]:
    """Build the symmetric matrix of the first n rows, shape (n, n).

    Examples
    --------
    >>> whole(packed(np.array([[1.0, 0.0], [2.0, 3.0]])), 2).tolist()
    [[1.0, 2.0], [2.0, 3.0]]
    """
    matrix = np.zeros((n, n))
    lower = np.tril_indices(n)
    matrix[lower] = matrix.T[lower] = triangle[entries(n)]
    return matrix


@compiled
def row_of(triangle: Vector, starts: Starts, a: int) -> Vector:
    """Entries 0 to a of row a, in place."""
    return triangle[starts[a] : starts[a] + a + 1]
