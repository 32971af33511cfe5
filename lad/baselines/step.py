"""What every baseline checks: that it can use an input, and can learn from a target."""

import math
from numbers import Real

import numpy as np
from numpy.typing import NDArray

from lad.assistant import Assistance
from lad.command import Command
from lad.errors import HyperparameterError, InvalidInputError, InvalidTargetError
from lad.inputs import N_INPUTS


def checked_input(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a copy of the inputs.

    Raises
    ------
    InvalidInputError
        When there are not 19 of them, or one is not finite.
    """
    seen = np.array(x, dtype=np.float64)
    if seen.shape != (N_INPUTS,) or not np.isfinite(seen).all():
        raise InvalidInputError(
            f"x: given shape {seen.shape}, finite: {bool(np.isfinite(seen).all())}; "
            f"allowed is ({N_INPUTS},), all finite"
        )
    return seen


def checked_look(seen: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """Return the inputs last seen in this lap.

    Raises
    ------
    InvalidTargetError
        When nothing was seen: there is nothing to learn a target for.
    """
    if seen is None:
        raise InvalidTargetError("learn: nothing was seen in this lap; assist comes first")
    return seen


def checked_command(helping: bool, command: Command | None) -> Command | None:
    """Return the command to be learnt; None where no help was given.

    Raises
    ------
    InvalidTargetError
        When help was given without a finite command.
    """
    if not helping:
        return None
    if command is None or not all(map(math.isfinite, command)):
        raise InvalidTargetError(f"command: given {command} while helping; allowed is a finite one")
    return command


def checked_threshold(threshold: float) -> float:
    """Return W_h.

    Raises
    ------
    HyperparameterError
        When it is not a number from 0 to 1.
    """
    if isinstance(threshold, bool) or not isinstance(threshold, Real) or not 0 <= threshold <= 1:
        raise HyperparameterError(f"threshold: given {threshold!r}; allowed is 0 to 1")
    return float(threshold)


def answer(p_help: float, mean: Command | None, threshold: float) -> Assistance:
    """Return the answer of an assistant that helps when p(h = 1 | x) >= W_h and has a command."""
    helping = mean is not None and p_help >= threshold
    return Assistance(helping=helping, command=mean if helping else None, p_help=p_help, mean=mean)
