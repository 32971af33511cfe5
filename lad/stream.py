"""A whole recorded stream at once: observe, predict, learn, for every step of it."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from lad.errors import InvalidInputError, InvalidTargetError
from lad.update import Prediction, Update

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class OnlineProcess(Protocol):
    """What ``learn_stream`` needs of a process; ``StorkGP`` and ``PlainStorkGP`` both have it."""

    def observe(self, x: Floats) -> None:
        """Advance the window."""

    def predict(self) -> Prediction:
        """Predict at the current window."""

    def learn(self, y: object) -> Update:
        """Learn the target of the current window."""

    def check(self, x: object, y: object | None = None) -> None:
        """Raise what ``observe`` and ``learn`` would raise, and change nothing."""

    @property
    def n_basis(self) -> int:
        """Number of basis vectors."""


@dataclass(frozen=True)
class Predictions:
    """Predictions of N steps: ``mean`` (N, p), ``latent_variance`` and ``variance`` (N,)."""

    mean: Floats
    latent_variance: Floats
    variance: Floats


@dataclass(frozen=True)
class Learning:
    """What happened in N learning steps, each predicted before it was learnt.

    Attributes
    ----------
    predictions
        Out of sample: made before the step was learnt.
    kind
        Shape (N,): ``UpdateKind`` of each step.
    novelty
        Shape (N,): gamma / k(x, x) before the step.
    deleted_time
        Shape (N,): time index of the basis vector deleted; -1 for none.
    n_basis
        Shape (N,): basis vectors after the step.
    """

    predictions: Predictions
    kind: Integers
    novelty: Floats
    deleted_time: Integers
    n_basis: Integers


def predict_stream(process: OnlineProcess, X: Floats) -> Predictions:
    """Observe and predict every row of X, shape (N, d), learning nothing.

    Raises
    ------
    InvalidInputError
        When a row cannot be observed; the whole stream is checked before anything changes.
    """
    rows = _rows(X, "X", InvalidInputError)
    _check(process, rows, None)
    return _stacked([_look(process, x) for x in rows])


def learn_stream(process: OnlineProcess, X: Floats, Y: Floats) -> Learning:
    """Observe, predict and learn every row of X (N, d) and Y (N, p), in order.

    The same computation, to the last bit, as doing so step by step.

    Raises
    ------
    InvalidInputError, InvalidTargetError
        When a row cannot be observed or learnt; the whole stream is checked before anything
        changes.
    """
    inputs, targets = _rows(X, "X", InvalidInputError), _rows(Y, "Y", InvalidTargetError)
    if len(inputs) != len(targets):
        raise InvalidTargetError(f"Y: given {len(targets)} rows; allowed are {len(inputs)} as in X")
    _check(process, inputs, targets)
    predictions, updates, sizes = [], [], []
    for x, y in zip(inputs, targets, strict=True):
        predictions.append(_look(process, x))
        updates.append(process.learn(y))
        sizes.append(process.n_basis)
    return Learning(
        predictions=_stacked(predictions),
        kind=np.array([update.kind for update in updates], dtype=np.int64),
        novelty=np.array([update.novelty for update in updates], dtype=np.float64),
        deleted_time=np.array(
            [-1 if u.deleted_time is None else u.deleted_time for u in updates], dtype=np.int64
        ),
        n_basis=np.array(sizes, dtype=np.int64),
    )


def _rows(values: Floats, name: str, error: type[ValueError]) -> NDArray[np.generic]:
    array = np.asarray(values)
    if array.ndim != 2:
        raise error(f"{name}: given shape {array.shape}; allowed is (steps, columns)")
    return array


def _check(process: OnlineProcess, X: NDArray[np.generic], Y: NDArray[np.generic] | None) -> None:
    for step, x in enumerate(X):
        try:
            process.check(x, None if Y is None else Y[step])
        except ValueError as error:
            raise type(error)(f"step {step}: {error}") from None


def _look(process: OnlineProcess, x: Floats) -> Prediction:
    process.observe(x)
    return process.predict()


def _stacked(predictions: list[Prediction]) -> Predictions:
    return Predictions(
        mean=np.array([one.mean for one in predictions]),
        latent_variance=np.array([one.latent_variance for one in predictions]),
        variance=np.array([one.variance for one in predictions]),
    )
