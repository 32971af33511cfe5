"""A classifier for when and a regressor for how, fitted again after every demonstration."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.assistant import Assistance
from lad.baselines.step import (
    answer,
    checked_command,
    checked_input,
    checked_look,
    checked_threshold,
)
from lad.command import Command


class RefittedAssistant:
    """Keeps every step it is taught, and fits two estimators when the next lap starts.

    During a demonstration it answers from the earlier ones; in the first one p(h = 1 | x) is 0.
    When all steps so far had the same answer, p is that answer: 0 or 1.

    Parameters
    ----------
    classifier, regressor
        Unfitted, with scikit-learn's ``fit``, ``predict`` and, for the classifier,
        ``predict_proba``; the regressor has two outputs, and is fitted where help was given.
    threshold
        W_h: helps from this p(h = 1 | x) on.
    """

    def __init__(self, classifier: Any, regressor: Any, threshold: float = 0.5) -> None:
        self._classifier, self._regressor = classifier, regressor
        self._threshold = checked_threshold(threshold)
        self._inputs: list[NDArray[np.float64]] = []
        self._commands: list[Command | None] = []
        self._fitted_on = 0
        self._helped = np.zeros(0, dtype=np.bool_)
        self._now: NDArray[np.float64] | None = None

    def start_lap(self) -> None:
        """Fit what was taught since the last time."""
        self._now = None
        if self._fitted_on < len(self._inputs):
            self._fit()

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Answer from what the demonstrations before this lap have taught.

        Raises
        ------
        InvalidInputError
            When x is not 19 finite numbers; nothing has changed.
        """
        self._now = checked_input(x)
        if not self._helped.any():
            return answer(0.0, None, self._threshold)
        row = self._now[None, :]
        p = 1.0 if self._helped.all() else float(self._classifier.predict_proba(row)[0, 1])
        v, w = self._regressor.predict(row)[0].tolist()
        return answer(p, Command(v, w), self._threshold)

    def learn(self, helping: bool, command: Command | None) -> None:
        """Keep the step last seen by ``assist`` for the next fit.

        Raises
        ------
        InvalidTargetError
            When nothing was seen in this lap, or help was given without a finite command.
        """
        seen, checked = checked_look(self._now), checked_command(helping, command)
        self._inputs.append(seen)
        self._commands.append(checked)

    def _fit(self) -> None:
        inputs = np.array(self._inputs)
        commands = [c for c in self._commands if c is not None]
        self._helped = np.array([c is not None for c in self._commands], dtype=np.bool_)
        self._fitted_on = len(inputs)
        if commands:
            self._regressor.fit(inputs[self._helped], np.array(commands))
        if commands and len(commands) < len(inputs):
            self._classifier.fit(inputs, self._helped)
