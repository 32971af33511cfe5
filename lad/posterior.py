"""A Gaussian process in its natural parameters, equations (4) and (5)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Posterior:
    """m(x) = alpha' k(x) and v(x, x') = k(x, x') + k(x)' C k(x'), k over n basis vectors.

    Attributes
    ----------
    alpha
        Shape (n, p).
    C
        Shape (n, n), symmetric.
    Q
        Shape (n, n), symmetric: the inverse of the kernel matrix of the basis vectors.
    """

    alpha: NDArray[np.float64]
    C: NDArray[np.float64]
    Q: NDArray[np.float64]
