"""The seam every assistant fits: a demonstrator, the learned model, or your own."""

from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from lad.command import Command


class Assistance(NamedTuple):
    """What an assistant answers in one step.

    Attributes
    ----------
    helping
        Whether it wants its command to count now (the paper's h = +1).
    command
        The command it proposes; None when it does not help and proposes none.
    p_help
        p(h = 1 | x), in [0, 1]; None for an assistant that computes no probability.
    mean
        Predicted assistive action, also when it is not helping; None as for ``p_help``.
    variance
        Predictive variance of the action including noise, the same for both components
        ((m/s)^2 and (rad/s)^2); None as for ``p_help``.
    share
        Level of assistance, the assistant's share of a mixed command, in [0, 1]; None for one that
        learns none.
    """

    helping: bool
    command: Command | None = None
    p_help: float | None = None
    mean: Command | None = None
    variance: float | None = None
    share: float | None = None


NO_ASSISTANCE = Assistance(helping=False)


class Assistant(Protocol):
    """Gives help. The lap calls it once in every step, also when its help does not count."""

    def start_lap(self) -> None:
        """Forget the last lap's inputs; keep what was learnt."""

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Look at the inputs (shape (19,), order of ``lad.inputs.INPUT_NAMES``) and answer."""


@runtime_checkable
class Learner(Protocol):
    """An assistant that learns from a demonstration, step by step."""

    def learn(self, helping: bool, command: Command | None) -> None:
        """Learn the step last seen by ``assist``.

        Parameters
        ----------
        helping
            Whether the demonstrator had taken over.
        command
            The demonstrator's command; None when it had not.
        """
