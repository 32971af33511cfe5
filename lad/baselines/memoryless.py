"""The shipped model without its memory: an ordinary sparse Gaussian process of the inputs."""

from typing import Any

from lad.hyperparameters import LADParameters
from lad.lad_assistant import LADAssistant


def make(**parameters: Any) -> LADAssistant:
    """Return the shipped model with tau = 1: the state is the current input alone.

    Parameters
    ----------
    parameters
        Others of ``LADParameters``; Table I by default.

    Examples
    --------
    >>> make().parameters.recursion_depth
    1
    """
    return LADAssistant(LADParameters(**{"recursion_depth": 1, **parameters}))
