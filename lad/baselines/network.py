"""A small neural network for when to help and one for how: online, or fitted per demonstration."""

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.assistant import Assistance
from lad.baselines.estimators import (
    ConvergenceWarning,
    MLPClassifier,
    MLPRegressor,
    StandardScaler,
    make_pipeline,
)
from lad.baselines.refitted import RefittedAssistant
from lad.baselines.step import (
    answer,
    checked_command,
    checked_input,
    checked_look,
    checked_threshold,
)
from lad.command import Command

UNITS = 32
"""Hidden units of either network, in one layer."""

EPOCHS = 200
"""Passes over all demonstrations when it is fitted again."""


class OnlineNetwork:
    """Two networks that take one step of gradient descent (Adam) for each step they are taught.

    Inputs are standardised over the steps seen in teaching so far.

    Parameters
    ----------
    seed
        Of the initial weights.
    threshold
        W_h.
    """

    def __init__(self, seed: int = 0, threshold: float = 0.5) -> None:
        self._threshold = checked_threshold(threshold)
        self._scaler = StandardScaler()
        self._when = MLPClassifier(hidden_layer_sizes=(UNITS,), random_state=seed)
        self._how = MLPRegressor(hidden_layer_sizes=(UNITS,), random_state=seed)
        self._taught = self._shown = 0
        self._now: NDArray[np.float64] | None = None

    def start_lap(self) -> None:
        """Forget the last lap's last step."""
        self._now = None

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Answer; p(h = 1 | x) is 0 before the first step was taught.

        Raises
        ------
        InvalidInputError
            When x is not 19 finite numbers; nothing has changed.
        """
        self._now = checked_input(x)
        if not self._taught:
            return answer(0.0, None, self._threshold)
        row = self._scaler.transform(self._now[None, :])
        p = float(self._when.predict_proba(row)[0, 1])
        mean = Command(*self._how.predict(row)[0].tolist()) if self._shown else None
        return answer(p, mean, self._threshold)

    def learn(self, helping: bool, command: Command | None) -> None:
        """Learn the step last seen by ``assist``.

        Raises
        ------
        InvalidTargetError
            When nothing was seen in this lap, or help was given without a finite command.
        """
        seen, checked = checked_look(self._now)[None, :], checked_command(helping, command)
        row = self._scaler.partial_fit(seen).transform(seen)
        self._when.partial_fit(row, [checked is not None], classes=[False, True])
        self._taught += 1
        if checked is not None:
            self._how.partial_fit(row, [list(checked)])
            self._shown += 1


def make(seed: int = 0, threshold: float = 0.5) -> OnlineNetwork:
    """Return a network that learns online; see ``OnlineNetwork``."""
    return OnlineNetwork(seed, threshold)


def make_refitted(seed: int = 0, threshold: float = 0.5) -> RefittedAssistant:
    """Return the same two networks, trained again from the start after each demonstration.

    Parameters
    ----------
    seed
        Of the initial weights and of the order of steps.
    threshold
        W_h.
    """
    settings = {"hidden_layer_sizes": (UNITS,), "random_state": seed, "max_iter": EPOCHS}
    when, how = MLPClassifier(**settings), MLPRegressor(**settings)
    return RefittedAssistant(_QuietNetwork(when), _QuietNetwork(how), threshold)


class _QuietNetwork:
    """Standardises and fits; hides the warning that all passes were used, one per lap."""

    def __init__(self, network: Any) -> None:
        self._estimator = make_pipeline(StandardScaler(), network)
        self.predict = self._estimator.predict

    def fit(self, inputs: Any, targets: Any) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)
            self._estimator.fit(inputs, targets)

    def predict_proba(self, inputs: Any) -> Any:
        return self._estimator.predict_proba(inputs)
