"""What a prediction leans on: the basis vectors behind the mean."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lad.stork_gp import StorkGP


@dataclass(frozen=True)
class Influence:
    """One basis vector's part in a prediction.

    Attributes
    ----------
    time
        Which input of the model's life it is, from 0.
    lap
        In which lap of the model's life it was learnt, from 0.
    inputs
        Shape (tau, d): what was seen then, newest first, in the inputs' units.
    likeness
        kappa(b, x), from 0 (nothing in common) to 1 (the same window): k(b, x) / k(x, x) of a
        kernel without a constant.
    contribution
        Shape (p,): k(b, x) alpha; over all basis vectors, and the prior mean where there is one,
        they sum to the mean.
    """

    time: int
    lap: int
    inputs: NDArray[np.float64]
    likeness: float
    contribution: NDArray[np.float64]


def explain(process: StorkGP, most: int | None = 5) -> list[Influence]:
    """Say which basis vectors the prediction at the window leans on, the strongest first.

    Parameters
    ----------
    process
        A trained process; it is not changed.
    most
        How many to name; None for all.

    Returns
    -------
    list of Influence
        By length of the contribution, longest first.
    """
    k, state, hyper = process.covariances(), process.state, process.hyperparameters
    contributions = (k * state.alpha[:, : state.n]).T
    order = np.argsort(-np.linalg.norm(contributions, axis=1), kind="stable")
    return [
        Influence(
            time=int(state.times[slot]),
            lap=int(state.laps[slot]),
            inputs=state.basis[:, :, slot] * process.window.lengthscales,
            likeness=float((k[slot] - hyper.constant_variance) / hyper.signal_variance),
            contribution=contributions[slot].copy(),
        )
        for slot in order[:most]
    ]
