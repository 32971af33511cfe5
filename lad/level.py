"""An assistant that learns, besides when and how to help, how much of the command to give."""

from collections.abc import Mapping
from typing import ClassVar

from lad.assistant import Assistance
from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.errors import HyperparameterError
from lad.hyperparameters import LADParameters
from lad.stork_gp import StorkGP

LEAST_DIFFERENCE = 0.05
"""Commands nearer to each other than this, in m/s and rad/s, tell nothing about a share."""


class LevelAssistant(CorrectionAssistant):
    """Learns when and how to help as ``lad-correction`` does, and at which level.

    A third process learns the level of assistance, the model's share of the command. Its target is
    the share with which the mixed command would have come nearest to the demonstrator's:

        s = clip((a - u) . (m - u) / |m - u|^2, 0, 1) while help is given, 0 else,

    with the user's limited command u, the demonstrator's a, and m what the model would have said
    before it learnt the step. A model that says what the demonstrator does earns the whole share;
    one that says something else, or helps where nobody did, earns none. Where m and u are the same
    within ``LEAST_DIFFERENCE`` nothing is told, and the share is 1 while help is given. The process
    is a regression with Table I and prior mean 0: where nothing is known the user has all of it.

    That a level of assistance can be learnt from demonstrations, beside p(h), follows Kucukyilmaz &
    Demiris (2018); the target above is this library's own. ``arbitration: blend-learnt`` uses it.

    Parameters
    ----------
    parameters
        As of ``lad-correction``; the third process takes the regressor's without sigma_c^2.
        ``tune`` leaves it as it is.

    Attributes
    ----------
    level
        The third process, one output, with a window of its own.

    Raises
    ------
    HyperparameterError
        When ``memory_laps`` is given: the third process does not forget.

    Examples
    --------
    >>> import numpy as np
    >>> model = LevelAssistant()
    >>> model.start_lap()
    >>> x = np.zeros(19)
    >>> model.assist(x).share
    0.0
    >>> for _ in range(20):
    ...     _ = model.assist(x)
    ...     model.learn(helping=True, command=Command(0.3, -0.5))
    >>> round(model.assist(x).share, 1)
    1.0
    """

    kind: ClassVar[str] = "lad-level"

    def __init__(self, parameters: LADParameters | None = None) -> None:
        super().__init__(parameters)
        if self.parameters.memory_laps is not None:
            raise HyperparameterError("lad-level: memory_laps: it does not forget; allowed: null")
        alone = self.parameters.model_copy(update={"constant_variance": 0.0})
        self.level = StorkGP(alone.regressor)

    @property
    def processes(self) -> Mapping[str, StorkGP]:
        """When, how and level."""
        return {**super().processes, "level": self.level}

    def _answer(self) -> Assistance:
        share = float(self.level.predict().mean[0])
        return super()._answer()._replace(share=min(max(share, 0.0), 1.0))

    def _learn(self, target: Command | None) -> None:
        predicted = Command(*self.how.predict().mean.tolist())  # before it learns the step
        super()._learn(target)
        self.level.learn(0.0 if target is None else share_of(target, predicted))


def share_of(given: Command, predicted: Command) -> float:
    """Return the share of a predicted correction that comes nearest to the one that was given.

    Parameters
    ----------
    given, predicted
        Corrections to the user's command, m/s and rad/s.

    Returns
    -------
    float
        In [0, 1]; 1 where the predicted correction is shorter than ``LEAST_DIFFERENCE``.

    Examples
    --------
    >>> share_of(Command(0.0, -0.2), Command(0.0, -0.4))
    0.5
    >>> share_of(Command(0.0, 0.2), Command(0.0, -0.4))
    0.0
    """
    square = predicted.v**2 + predicted.w**2
    if square < LEAST_DIFFERENCE**2:
        return 1.0
    return min(max((given.v * predicted.v + given.w * predicted.w) / square, 0.0), 1.0)
