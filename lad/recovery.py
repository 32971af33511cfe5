"""Recovery from a posterior that rounding has made impossible.

In exact arithmetic a posterior variance is never negative. In float64, with noise far below the
signal and inputs closely alike, k'Ck can pass below -k(x, x); a step taken from there has the
wrong sign, the next one is larger, and soon nothing is finite. Table I's numbers do not come near
it. With other numbers the model is rebuilt when that happens, as if each basis vector had been
observed once, at the model's own mean there.
"""

import numpy as np

from lad import fused
from lad.health import KernelMatrix
from lad.inverse import invert
from lad.update import SMALLEST_NOVELTY

TOLERATED_SHARE = 0.1
"""A variance below minus this share of the noise is taken for impossible: steps still contract."""

LEAST_NOISE_SHARE = 1e-6


def is_possible(latent: float, noise: float) -> bool:
    """Return whether a latent variance, not yet kept positive, can be learnt from; NaN cannot."""
    return latent >= -TOLERATED_SHARE * noise


def rebuild(matrix: KernelMatrix, noise: float) -> None:
    """Make alpha and C those of one observation per basis vector, at the present mean.

    C = -(K + d I)^-1 and alpha <- (K + d I)^-1 K alpha, with d the noise or a millionth of the
    prior variance, whichever is more. Values that are no longer finite are forgotten.

    Parameters
    ----------
    matrix
        Kernel matrix of the basis vectors; its state is changed.
    noise
        sigma_n^2.
    """
    state, n = matrix.state, matrix.state.n
    d = max(noise, LEAST_NOISE_SHARE * matrix.prior)
    matrix.fill(state.C, d)
    invert(state.C, state.starts, n, SMALLEST_NOVELTY)
    product = np.empty(state.room)
    for row in state.alpha:
        if np.isfinite(row[:n]).all():
            fused.symmetric_product(state.C, state.starts, row, n, product)
            row[:n] -= d * product[:n]
        else:
            row[:n] = 0.0
    np.negative(state.C, out=state.C)
