"""What was done in the most similar steps: k nearest neighbours, fitted per demonstration."""

from typing import Any

from lad.baselines.estimators import (
    KNeighborsClassifier,
    KNeighborsRegressor,
    StandardScaler,
    make_pipeline,
)
from lad.baselines.refitted import RefittedAssistant
from lad.errors import HyperparameterError


class _NearestAvailable:
    """Uses all neighbours there are when there are fewer than ``k``."""

    def __init__(self, neighbours: Any, k: int) -> None:
        self._neighbours, self._k = neighbours, k
        self._estimator = make_pipeline(StandardScaler(), neighbours)

    def fit(self, inputs: Any, targets: Any) -> Any:
        self._neighbours.set_params(n_neighbors=min(self._k, len(inputs)))
        return self._estimator.fit(inputs, targets)

    def predict(self, inputs: Any) -> Any:
        return self._estimator.predict(inputs)

    def predict_proba(self, inputs: Any) -> Any:
        return self._estimator.predict_proba(inputs)


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
    # A tree, not brute force: that would start threads in every session's process.
    when = _NearestAvailable(KNeighborsClassifier(algorithm="kd_tree"), k)
    how = _NearestAvailable(KNeighborsRegressor(algorithm="kd_tree"), k)
    return RefittedAssistant(when, how, threshold)
