"""Peers that a Python user would take: exact Gaussian processes, refitted or extended.

Their kernel is the squared exponential over the flattened window, since neither knows the
recursive one; the work is the same.
"""

from collections.abc import Callable

import numpy as np

from lad.hyperparameters import GPHyperparameters


def flattened(basis: np.ndarray, n: int) -> np.ndarray:
    """Turn basis vectors (tau, d, room), over their lengthscales, into rows (n, tau d)."""
    return np.ascontiguousarray(basis[:, :, :n].reshape(-1, n).T)


def sklearn_steps(
    hyper: GPHyperparameters, X: np.ndarray, Y: np.ndarray
) -> dict[str, Callable[[np.ndarray], None]]:
    """Each operation with scikit-learn: whatever is learnt, the process is fitted again."""
    from sklearn.gaussian_process import GaussianProcessRegressor  # noqa: PLC0415  # optional
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel  # noqa: PLC0415  # optional

    kernel = ConstantKernel(hyper.signal_variance, "fixed") * RBF(1.0, "fixed")
    process = GaussianProcessRegressor(kernel, alpha=hyper.noise_variance, optimizer=None)
    process.fit(X, Y)

    def predict(x: np.ndarray) -> None:
        process.predict(x[None], return_std=True)

    def refit(x: np.ndarray) -> None:
        process.predict(x[None], return_std=True)
        process.fit(X, Y)

    return {"predict": predict, "sparse": refit, "full": refit, "full+delete": refit}


def gpytorch_steps(
    hyper: GPHyperparameters, X: np.ndarray, Y: np.ndarray
) -> dict[str, Callable[[np.ndarray], None]]:
    """Prediction, and extension by one sample as a fantasy, with GPyTorch; one output."""
    import gpytorch  # noqa: PLC0415  # optional
    import torch  # noqa: PLC0415  # optional

    torch.set_num_threads(1)
    inputs, targets = torch.as_tensor(X), torch.as_tensor(Y[:, 0].copy())
    likelihood = gpytorch.likelihoods.GaussianLikelihood().double()

    class Exact(gpytorch.models.ExactGP):
        def __init__(self) -> None:
            super().__init__(inputs, targets, likelihood)
            self.mean_module = gpytorch.means.ZeroMean()
            self.covar_module = gpytorch.kernels.ScaleKernel(gpytorch.kernels.RBFKernel())

        def forward(self, x: "torch.Tensor") -> "gpytorch.distributions.MultivariateNormal":
            return gpytorch.distributions.MultivariateNormal(
                self.mean_module(x), self.covar_module(x)
            )

    process = Exact().double()
    process.covar_module.outputscale = hyper.signal_variance
    process.covar_module.base_kernel.lengthscale = 1.0
    likelihood.noise = hyper.noise_variance
    process.eval()
    likelihood.eval()

    def predict(x: np.ndarray) -> None:
        with torch.no_grad(), gpytorch.settings.fast_pred_var():
            answer = process(torch.as_tensor(x[None]))
            answer.mean.numpy(), answer.variance.numpy()

    def extend(x: np.ndarray) -> None:
        predict(x)
        with torch.no_grad(), gpytorch.settings.fast_pred_var():
            process.get_fantasy_model(torch.as_tensor(x[None]), targets[:1])

    predict(X[0])
    return {"predict": predict, "full": extend}
