"""The predictive density of equation (1): either the assistant acts, or nothing is done."""

import math

from lad.assistant import Assistance
from lad.command import Command
from lad.errors import InvalidTargetError


def log_density(prediction: Assistance, action: Command | None) -> float:
    """Log of equation (1) at what the demonstrator did.

    The density has two parts, so it is taken with respect to a point mass at the null action
    (no help) and area everywhere else: log(1 - p(h = 1)) when there was no help, and
    log p(h = 1) + log N(a | mean, variance I) when there was.

    Parameters
    ----------
    prediction
        An answer with ``p_help``, ``mean`` and ``variance``, made before the step was learnt.
    action
        The demonstrator's command; None when it did not help.

    Returns
    -------
    float
        In nats; of a density per (m/s)(rad/s) when there was help, so it may be positive. Minus
        infinity when the prediction ruled out what happened.

    Raises
    ------
    InvalidTargetError
        When the prediction has no probability, mean or variance.

    Examples
    --------
    >>> surely_not = Assistance(False, None, 0.0, Command(0.0, 0.0), 0.1)
    >>> log_density(surely_not, None)
    0.0
    >>> log_density(surely_not, Command(0.3, -0.5))
    -inf
    """
    p_help, mean, variance = prediction.p_help, prediction.mean, prediction.variance
    if p_help is None or mean is None or variance is None:
        raise InvalidTargetError(
            "prediction: given one without p_help, mean or variance; allowed is a model's answer"
        )
    if action is None:
        return _log(1.0 - p_help)
    squared = (action.v - mean.v) ** 2 + (action.w - mean.w) ** 2
    return _log(p_help) - math.log(2.0 * math.pi * variance) - 0.5 * squared / variance


def _log(probability: float) -> float:
    return math.log(probability) if probability > 0.0 else -math.inf
