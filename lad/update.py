"""What one prediction and one learning step report."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

SMALLEST_VARIANCE = 1e-12
"""Latent variances are never reported, nor used, below this."""

SMALLEST_NOVELTY = 1e-12
"""A residual variance gamma below this counts as 0, which is never novel."""


SMALLEST_SHARE = 1e-12
"""q* + c* of a deletion counts as at least this share of q*; in exact arithmetic it is positive."""


class UpdateKind(IntEnum):
    """How a sample was taken in."""

    FIRST = 0
    SPARSE = 1
    FULL = 2
    FULL_THEN_DELETION = 3


class Update(NamedTuple):
    """What one learning step did.

    Attributes
    ----------
    kind
        First, sparse, full, or full followed by the deletion of a basis vector.
    novelty
        gamma / k(x, x) before the step: the share of the prior variance that the basis vectors
        leave unexplained; 1 for the first sample.
    deleted_time
        Time index of the basis vector that was deleted; None when none was.
    """

    kind: UpdateKind
    novelty: float
    deleted_time: int | None = None


class Prediction(NamedTuple):
    """A predictive distribution, the same variance for every output.

    Attributes
    ----------
    mean
        Shape (p,), equation (8).
    latent_variance
        Equation (9), without noise; positive.
    variance
        Of an observation: the latent variance and the noise.
    """

    mean: NDArray[np.float64]
    latent_variance: float
    variance: float
