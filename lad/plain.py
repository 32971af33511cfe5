"""STORK-GP as the equations define it: dense numpy, a matrix per line, nothing in place.

This is the definition. The class people use, ``lad.stork_gp.StorkGP``, computes the same numbers
in place and many times faster, and is tested against this one.
"""

import numpy as np
from numpy.typing import NDArray

from lad.hyperparameters import GPHyperparameters
from lad.kernel import recursive_kernel
from lad.likelihood import Evidence, LikelihoodName, check_outputs, check_target, evidence
from lad.posterior import Posterior
from lad.update import (
    SMALLEST_NOVELTY,
    SMALLEST_SHARE,
    SMALLEST_VARIANCE,
    Prediction,
    Update,
    UpdateKind,
)
from lad.window import Window


def _bordered(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.pad(matrix, ((0, 1), (0, 1)))


def full_update(
    state: Posterior, k: NDArray[np.float64], gamma: float, q: NDArray[np.float64], r: float
) -> Posterior:
    """Add the sample as a basis vector."""
    s = np.append(state.C @ k, 1.0)
    e = np.append(state.Q @ k, -1.0)
    return Posterior(
        np.vstack([state.alpha, np.zeros_like(q)]) + np.outer(s, q),
        _bordered(state.C) + r * np.outer(s, s),
        _bordered(state.Q) + np.outer(e, e) / gamma,
    )


def sparse_update(
    state: Posterior, k: NDArray[np.float64], gamma: float, q: NDArray[np.float64], r: float
) -> Posterior:
    """Project the sample onto the basis vectors there are."""
    eta = 1.0 / (1.0 + gamma * r)
    s = state.C @ k + state.Q @ k
    return Posterior(
        state.alpha + eta * np.outer(s, q), state.C + r * eta * np.outer(s, s), state.Q
    )


def starred_sum(q_star: NDArray[np.float64], c_star: NDArray[np.float64]) -> NDArray[np.float64]:
    """q* + c*, kept positive where rounding would not."""
    return np.maximum(q_star + c_star, SMALLEST_SHARE * q_star)


def deletion_scores(state: Posterior) -> NDArray[np.float64]:
    """Score every basis vector by how much the process would change without it."""
    squares: NDArray[np.float64] = np.square(state.alpha).sum(axis=1)
    return squares / starred_sum(np.diag(state.Q), np.diag(state.C))


def delete(state: Posterior, i: int) -> Posterior:
    """Remove basis vector i; the last one takes its place."""
    q_star = state.Q[i, i]
    sum_star = starred_sum(q_star, state.C[i, i])
    Q_column, sum_column = state.Q[:, i], state.Q[:, i] + state.C[:, i]
    Q_outer = np.outer(Q_column, Q_column) / q_star
    alpha = state.alpha - np.outer(sum_column, state.alpha[i]) / sum_star
    C = state.C + Q_outer - np.outer(sum_column, sum_column) / sum_star
    Q = state.Q - Q_outer
    kept = without(i, len(alpha))
    return Posterior(alpha[kept], C[np.ix_(kept, kept)], Q[np.ix_(kept, kept)])


def without(i: int, n: int) -> NDArray[np.intp]:
    """Order of the n - 1 that stay: the last one takes place i."""
    order = np.arange(n)
    order[i] = n - 1
    return order[:-1]


class PlainStorkGP:
    """The readable form of ``lad.stork_gp.StorkGP``, with the same interface.

    Parameters
    ----------
    hyperparameters
        Checked hyperparameters.
    likelihood
        ``gaussian`` for regression, ``probit`` for labels -1 and +1.
    n_outputs
        Number of outputs p; they share C and Q.
    """

    def __init__(
        self,
        hyperparameters: GPHyperparameters,
        likelihood: LikelihoodName = "gaussian",
        n_outputs: int = 1,
    ) -> None:
        check_outputs(likelihood, n_outputs)
        self.hyperparameters = hyperparameters
        self.likelihood = likelihood
        self.n_outputs = n_outputs
        self.window = Window(
            np.array(hyperparameters.lengthscales), hyperparameters.recursion_depth
        )
        self.basis = np.zeros((0, hyperparameters.recursion_depth, hyperparameters.n_inputs))
        self.times = np.zeros(0, dtype=np.int64)
        self.state = Posterior(np.zeros((0, n_outputs)), np.zeros((0, 0)), np.zeros((0, 0)))

    def observe(self, x: NDArray[np.float64]) -> None:
        """Advance the window by one input, shape (d,)."""
        self.window.observe(x)

    def reset_window(self) -> None:
        """Start a new lap."""
        self.window.reset()

    @property
    def n_basis(self) -> int:
        """Number of basis vectors n."""
        return len(self.basis)

    def check(self, x: object, y: object | None = None) -> None:
        """Raise what ``observe`` and ``learn`` would raise, and change nothing."""
        self.window.check(x)
        if y is not None:
            check_target(y, self.n_outputs, self.likelihood)

    def kernel(self) -> NDArray[np.float64]:
        """Covariance of the window with every basis vector, shape (n,)."""
        hyper = self.hyperparameters
        return recursive_kernel(
            self.basis,
            self.window.scaled,
            hyper.squared_temporal_scale,
            hyper.signal_variance,
            hyper.constant_variance,
        )

    def predict(self) -> Prediction:
        """Predict at the current window: equations (8) and (9)."""
        k = self.kernel()
        hyper = self.hyperparameters
        latent = max(hyper.prior_variance + float(k @ self.state.C @ k), SMALLEST_VARIANCE)
        return Prediction(
            hyper.prior_mean + k @ self.state.alpha, latent, latent + hyper.noise_variance
        )

    def learn(self, y: object) -> Update:
        """Learn the target of the current window."""
        target = check_target(y, self.n_outputs, self.likelihood)
        prediction = self.predict()
        derivatives = evidence(target, prediction.mean, prediction.variance, self.likelihood)
        return self._update(self.kernel(), derivatives)

    def _update(self, k: NDArray[np.float64], derivatives: Evidence) -> Update:
        hyper = self.hyperparameters
        prior = hyper.prior_variance
        gamma = float(prior - k @ self.state.Q @ k)
        novelty = gamma / prior if gamma >= SMALLEST_NOVELTY else 0.0
        if gamma < max(hyper.novelty * prior, SMALLEST_NOVELTY):
            self.state = sparse_update(self.state, k, gamma, *derivatives)
            return Update(UpdateKind.SPARSE, novelty)
        self.state = full_update(self.state, k, gamma, *derivatives)
        self.basis = np.concatenate([self.basis, self.window.scaled[None]])
        self.times = np.append(self.times, self.window.time)
        if len(self.basis) == 1:
            return Update(UpdateKind.FIRST, novelty)
        if len(self.basis) <= hyper.capacity:
            return Update(UpdateKind.FULL, novelty)
        return Update(UpdateKind.FULL_THEN_DELETION, novelty, self._forget_one())

    def _forget_one(self) -> int:
        i = int(np.argmin(deletion_scores(self.state)))
        time = int(self.times[i])
        kept = without(i, len(self.basis))
        self.state = delete(self.state, i)
        self.basis, self.times = self.basis[kept], self.times[kept]
        return time
