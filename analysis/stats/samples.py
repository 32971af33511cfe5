"""What every test does to its arrays first: one dimension, floats, no missing values."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Sample = ArrayLike | Sequence[float]


def present(values: Sample) -> NDArray[np.float64]:
    """Return the values that are not missing.

    Examples
    --------
    >>> present([1.0, float("nan"), 3.0])
    array([1., 3.])
    """
    array = np.asarray(values, dtype=np.float64).ravel()
    return array[np.isfinite(array)]


def settled(differences: Sample) -> NDArray[np.float64]:
    """Return the differences that are not missing, without the noise of computing them.

    0.3 - 0.2 and 0.2 - 0.1 are the same difference, and differ in the seventeenth digit. Ranks,
    ties, zeros and "all are equal" must not depend on that: ten digits of the largest one are kept.

    Examples
    --------
    >>> len(set(settled([0.3 - 0.2, 0.2 - 0.1])))
    1
    """
    d = present(differences)
    largest = np.abs(d).max(initial=0.0)
    if largest == 0:
        return d
    return np.round(d, 9 - math.floor(math.log10(largest)))


def present_pairs(x: Sample, y: Sample) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the pairs of which neither half is missing.

    Raises
    ------
    ValueError
        When the two differ in length.

    Examples
    --------
    >>> present_pairs([1.0, 2.0], [3.0, float("nan")])
    (array([1.]), array([3.]))
    """
    a = np.asarray(x, dtype=np.float64).ravel()
    b = np.asarray(y, dtype=np.float64).ravel()
    if a.shape != b.shape:
        raise ValueError(f"pairs need equal lengths; given {len(a)} and {len(b)}")
    both = np.isfinite(a) & np.isfinite(b)
    return a[both], b[both]
