"""The recursive kernel with automatic relevance determination, equation (7), as it is written."""

import numpy as np
from numpy.typing import NDArray


def recursive_kernel(
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    squared_temporal_scale: float,
    signal_variance: float,
    constant_variance: float = 0.0,
) -> NDArray[np.float64]:
    """Covariance of one window with many.

    kappa starts at 1; from the oldest lag to the newest,
    kappa <- exp(-|a - b|^2 / 2) exp((kappa - 1) / sigma_rho^2), in units of the lengthscales.

    Parameters
    ----------
    a
        Shape (..., tau, d): windows, newest input first, each input over its lengthscale.
    b
        Shape (tau, d).
    squared_temporal_scale
        sigma_rho^2 (not sigma_rho).
    signal_variance
        sigma_f^2.
    constant_variance
        sigma_c^2, added to every entry: the prior variance of a constant that is added to the
        function (integrated out; Rasmussen & Williams, Gaussian processes for machine learning,
        2006, section 2.7).

    Returns
    -------
    NDArray
        Shape (...,): sigma_f^2 kappa + sigma_c^2, between sigma_c^2 and sigma_f^2 + sigma_c^2.

    Examples
    --------
    >>> now = np.array([[1.0], [0.0]])
    >>> float(recursive_kernel(now, now, 1.21, 0.1))
    0.1
    """
    squared_distance = ((a - b) ** 2).sum(axis=-1)
    kappa = np.ones(squared_distance.shape[:-1])
    for lag in reversed(range(b.shape[0])):
        kappa = np.exp(-0.5 * squared_distance[..., lag] + (kappa - 1.0) / squared_temporal_scale)
    return signal_variance * kappa + constant_variance
