"""What a prediction depends on: the basis vectors behind the mean."""

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
        Shape (p,): sigma_f^2 kappa(b, x) alpha. Over all basis vectors they sum to the mean, less
        what every prediction shares: ``shared``.
    """

    time: int
    lap: int
    inputs: NDArray[np.float64]
    likeness: float
    contribution: NDArray[np.float64]


def explain(process: StorkGP, most: int | None = 5) -> list[Influence]:
    """Return the basis vectors that the prediction at the window depends on, the strongest first.

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
    local = k - hyper.constant_variance
    contributions = (local * state.alpha[:, : state.n]).T
    order = np.argsort(-np.linalg.norm(contributions, axis=1), kind="stable")
    return [
        Influence(
            time=int(state.times[slot]),
            lap=int(state.laps[slot]),
            inputs=state.basis[:, :, slot] * process.window.lengthscales,
            likeness=float(local[slot] / hyper.signal_variance),
            contribution=contributions[slot].copy(),
        )
        for slot in order[:most]
    ]


def shared(process: StorkGP) -> NDArray[np.float64]:
    """Return the part of every prediction that depends on no input, shape (p,).

    The prior mean, and with a constant in the kernel sigma_c^2 times the sum of alpha: for a
    model of corrections, the mean correction that was demonstrated, pulled towards 0.
    """
    state, hyper = process.state, process.hyperparameters
    return np.asarray(
        hyper.prior_mean + hyper.constant_variance * state.alpha[:, : state.n].sum(axis=1)
    )
