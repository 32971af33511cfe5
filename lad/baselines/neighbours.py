"""What was done in the most similar steps: k nearest neighbours, fitted per demonstration."""

import numpy as np
from numpy.typing import NDArray

from lad.baselines.estimators import KDTree, StandardScaler
from lad.baselines.refitted import RefittedAssistant
from lad.errors import HyperparameterError

LEAF = 30
"""Rows in a leaf of the tree, as in scikit-learn's estimators: among equally near rows, those that
are found first depend on it."""


class _Nearest:
    """Means over the targets of the k nearest rows; over all rows when there are fewer.

    The tree is asked directly: scikit-learn's estimators give the same numbers, and check and wrap
    a row so thoroughly that a look takes four times as long.
    """

    def __init__(self, k: int) -> None:
        self._k = k

    def fit(self, inputs: NDArray[np.float64], targets: NDArray[np.generic]) -> None:
        scaler = StandardScaler().fit(inputs)
        self._middle, self._spread = scaler.mean_, scaler.scale_
        self._tree = KDTree(scaler.transform(inputs), leaf_size=LEAF)
        self._targets = np.asarray(targets, dtype=np.float64)

    def predict(self, inputs: NDArray[np.float64]) -> NDArray[np.float64]:
        rows = (inputs - self._middle) / self._spread
        k = min(self._k, len(self._targets))
        nearest = self._tree.query(rows, k, return_distance=False)
        means: NDArray[np.float64] = self._targets[nearest].mean(axis=1)
        return means

    def predict_proba(self, inputs: NDArray[np.float64]) -> NDArray[np.float64]:
        p = self.predict(inputs)
        return np.column_stack([1.0 - p, p])


def make(k: int = 5, threshold: float = 0.5) -> RefittedAssistant:
    """Return an assistant that asks its k nearest neighbours.

    Inputs are standardised over the steps it was taught. p(h = 1 | x) is the share of the k
    neighbours in which help was given; the command is the mean of the k nearest ones with help.

    Parameters
    ----------
    k
        Number of neighbours, 1 or more.
    threshold
        W_h.
    """
    if type(k) is not int or k < 1:
        raise HyperparameterError(f"k: given {k!r}; allowed is a whole number, 1 or more")
    return RefittedAssistant(_Nearest(k), _Nearest(k), threshold)
