"""From the steps a model was taught to the hyperparameters of its two processes."""

from dataclasses import dataclass

import numpy as np

from lad.errors import TooFewStepsError
from lad.hyperparameters import GPHyperparameters, LADParameters
from lad.tuning.classifier import tune_signal_variance
from lad.tuning.distances import Distances
from lad.tuning.regressor import Chosen, tune_regressor
from lad.tuning.taught import TaughtSteps, spread_out

LEAST_STEPS = 20
"""Steps with help, and as many without, that tuning needs."""

MOST_STEPS = 400
"""Of each kind of target, steps that the evidence is computed of: it costs their cube."""

NOVELTY = 1e-3
"""Least novelty of a tuned regressor: with a large ratio of signal to noise Table I's 1e-4 keeps
vectors so alike that Q is repaired every few steps."""

GROUPS = (slice(0, 2), slice(2, 4), slice(4, None))
"""Inputs that share a lengthscale: the user's command, the velocities, the laser."""


@dataclass(frozen=True)
class Tuned:
    """What was chosen.

    Attributes
    ----------
    when, how
        Hyperparameters of the classifier and of the regressor.
    steps
        How many steps had been taught.
    """

    when: GPHyperparameters
    how: GPHyperparameters
    steps: int


def refuse_too_few(taught: TaughtSteps) -> None:
    """Refuse to tune on next to nothing.

    Raises
    ------
    TooFewStepsError
        When fewer than 20 steps with help, or without, were taught.
    """
    helped = int(taught.helped.sum())
    if min(helped, len(taught) - helped) < LEAST_STEPS:
        raise TooFewStepsError(
            f"tune: given {helped} steps with help and {len(taught) - helped} without; "
            f"allowed are {LEAST_STEPS} of each or more"
        )


def tune(parameters: LADParameters, taught: TaughtSteps) -> Tuned:
    """Choose hyperparameters by evidence; the parameters are where the prior is centred.

    Raises
    ------
    TooFewStepsError
        When fewer than 20 steps with help, or without, were taught.
    """
    refuse_too_few(taught)
    return Tuned(_classifier(parameters, taught), _regressor(parameters, taught), len(taught))


def _classifier(parameters: LADParameters, taught: TaughtSteps) -> GPHyperparameters:
    chosen = spread_out(len(taught), MOST_STEPS)
    distances = Distances.of(taught.stacked()[chosen], GROUPS)
    sizes = np.array(_lengthscales(parameters))
    kappa, _ = distances.kappa(sizes, parameters.classifier.squared_temporal_scale)
    labels = np.where(taught.helped[chosen], 1.0, -1.0)
    variance = tune_signal_variance(
        parameters.signal_variance, kappa, labels, parameters.noise_when, parameters.prior_help
    )
    return parameters.model_copy(update={"signal_variance": variance}).classifier


def _regressor(parameters: LADParameters, taught: TaughtSteps) -> GPHyperparameters:
    helped = np.flatnonzero(taught.helped)
    chosen = spread_out(len(helped), MOST_STEPS)
    distances = Distances.of(taught.stacked()[helped[chosen]], GROUPS)
    start = Chosen(
        parameters.signal_variance,
        parameters.noise_how,
        _lengthscales(parameters),
        parameters.constant_variance or 0.0,
    )
    scale = parameters.regressor.squared_temporal_scale
    found = tune_regressor(start, distances, taught.commands()[chosen], scale)
    user, velocity, laser = found.lengthscales
    changed = parameters.model_copy(
        update={
            "signal_variance": found.signal_variance,
            "noise_how": found.noise,
            "lengthscale_user": user,
            "lengthscale_velocity": velocity,
            "lengthscale_laser": laser,
            "constant_variance": found.constant_variance,
            "novelty": max(parameters.novelty, NOVELTY),
        }
    )
    return changed.regressor


def _lengthscales(parameters: LADParameters) -> tuple[float, float, float]:
    return (
        parameters.lengthscale_user,
        parameters.lengthscale_velocity,
        parameters.lengthscale_laser,
    )
