"""The recursive kernel over many windows, with its derivatives by the lengthscales."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Distances:
    """Squared distances between windows, by lag and by group of inputs.

    Attributes
    ----------
    squared
        Shape (tau, groups, n, n), in the inputs' own squared units.
    """

    squared: Floats

    @classmethod
    def of(cls, windows: Floats, groups: Sequence[slice]) -> "Distances":
        """Measure windows, shape (n, tau, d), over groups of inputs that share a lengthscale."""
        n, depth, _ = windows.shape
        squared = np.empty((depth, len(groups), n, n))
        for lag in range(depth):
            for g, inputs in enumerate(groups):
                x = windows[:, lag, inputs]
                norms = np.einsum("ij,ij->i", x, x)
                between = norms[:, None] + norms[None, :] - 2.0 * (x @ x.T)
                np.fill_diagonal(between, 0.0)
                squared[lag, g] = np.maximum(between, 0.0)
        return cls(squared)

    def kappa(
        self, lengthscales: Floats, squared_temporal_scale: float
    ) -> tuple[Floats, list[Floats]]:
        """Return equation (7)'s kappa, and its derivatives by each log lengthscale.

        With e_t = -1/2 sum_g D_tg / l_g^2 + (kappa_(t-1) - 1) / sigma_rho^2 and
        kappa_t = exp(e_t), d kappa_t / d log l_g = kappa_t (D_tg / l_g^2 +
        (d kappa_(t-1) / d log l_g) / sigma_rho^2).

        Parameters
        ----------
        lengthscales
            Shape (groups,).
        squared_temporal_scale
            sigma_rho^2.
        """
        n = self.squared.shape[-1]
        kappa = np.ones((n, n))
        slopes = [np.zeros((n, n)) for _ in lengthscales]
        for lag in reversed(range(len(self.squared))):
            scaled = [self.squared[lag, g] / size**2 for g, size in enumerate(lengthscales)]
            kappa = np.exp(-0.5 * sum(scaled) + (kappa - 1.0) / squared_temporal_scale)
            slopes = [
                kappa * (own + slope / squared_temporal_scale)
                for own, slope in zip(scaled, slopes, strict=True)
            ]
        return kappa, slopes
