"""The learning step with scipy's BLAS in place: what a careful numpy user would write.

The same numbers as ``lad``: lower triangles updated by dsyr, products by dsymv, the kernel in
numpy over arrays whose last axis runs over basis vectors. Five rank-one passes where the fused
step makes two of rank three and two.
"""

import numpy as np
from scipy.linalg.blas import dsymv, dsyr

from lad.hyperparameters import GPHyperparameters
from lad.likelihood import gaussian_evidence
from lad.state import State
from lad.triangle import whole
from lad.update import Prediction, Update, UpdateKind
from lad.window import Window


class BlasStorkGP:
    """A regression process over arrays of fixed room, begun from a trained state."""

    def __init__(self, hyperparameters: GPHyperparameters, state: State, room: int) -> None:
        n = state.n
        self.hyperparameters = hyperparameters
        self.window = Window(
            np.array(hyperparameters.lengthscales), hyperparameters.recursion_depth
        )
        self.n, self.room = n, room
        self.C, self.Q = (np.zeros((room, room), order="F") for _ in range(2))
        self.C[:n, :n], self.Q[:n, :n] = np.tril(whole(state.C, n)), np.tril(whole(state.Q, n))
        self.alpha = np.zeros((state.n_outputs, room))
        self.alpha[:, :n] = state.alpha[:, :n]
        self.basis = np.zeros((*state.basis.shape[:2], room))
        self.basis[:, :, :n] = state.basis[:, :, :n]
        self.differences = np.empty_like(self.basis)
        self.k, self.Ck, self.looked = np.zeros(room), np.zeros(room), -1

    def observe(self, x: np.ndarray) -> None:
        """Advance the window."""
        self.window.observe(x)

    def _look(self) -> None:
        if self.looked == self.window.version:
            return
        hyper = self.hyperparameters
        np.subtract(self.basis, self.window.scaled[:, :, None], out=self.differences)
        np.multiply(self.differences, self.differences, out=self.differences)
        squared = self.differences.sum(axis=1)
        squared *= -0.5
        kappa = np.ones(self.room)
        for lag in reversed(range(len(squared))):
            kappa = np.exp(squared[lag] + (kappa - 1.0) / hyper.squared_temporal_scale)
        self.k = hyper.signal_variance * kappa
        self.k[self.n :] = 0.0
        self.Ck = dsymv(1.0, self.C, self.k, lower=1)
        self.mean = self.alpha @ self.k
        self.latent = hyper.signal_variance + self.k @ self.Ck
        self.looked = self.window.version

    def predict(self) -> Prediction:
        """Predict at the window."""
        self._look()
        return Prediction(self.mean, self.latent, self.latent + self.hyperparameters.noise_variance)

    def learn(self, y: np.ndarray) -> Update:
        """Learn the target of the window."""
        self._look()
        hyper = self.hyperparameters
        q, r = gaussian_evidence(y, self.mean, self.latent + hyper.noise_variance)
        e = dsymv(1.0, self.Q, self.k, lower=1)
        gamma = hyper.signal_variance - self.k @ e
        self.looked = -1
        novelty = gamma / hyper.signal_variance
        if novelty < hyper.novelty:
            self._sparse(e, gamma, q, r)
            return Update(UpdateKind.SPARSE, novelty)
        if self.n < self.room:
            self._full(e, gamma, q, r)
            return Update(UpdateKind.FULL, novelty)
        slot = self._replace(e, gamma, q, r)
        return Update(UpdateKind.FULL_THEN_DELETION, novelty, slot)

    def _sparse(self, e: np.ndarray, gamma: float, q: np.ndarray, r: float) -> None:
        eta = 1.0 / (1.0 + gamma * r)
        s = self.Ck + e
        self.alpha += np.outer(eta * q, s)
        dsyr(r * eta, s, lower=1, a=self.C, overwrite_a=1)

    def _full(self, e: np.ndarray, gamma: float, q: np.ndarray, r: float) -> None:
        s = self.Ck
        s[self.n], e[self.n] = 1.0, -1.0
        self.alpha += np.outer(q, s)
        dsyr(r, s, lower=1, a=self.C, overwrite_a=1)
        dsyr(1.0 / gamma, e, lower=1, a=self.Q, overwrite_a=1)
        self.basis[:, :, self.n] = self.window.scaled
        self.n += 1

    def _replace(self, e: np.ndarray, gamma: float, q: np.ndarray, r: float) -> int:
        """Full update, then deletion; the new vector takes the slot; n if it was itself deleted."""
        s, n = self.Ck, self.n
        q_star = np.append(np.diagonal(self.Q) + e * e / gamma, 1.0 / gamma)
        sum_star = q_star + np.append(np.diagonal(self.C) + r * s * s, r)
        alpha = np.hstack([self.alpha + np.outer(q, s), q[:, None]])
        slot = int(np.argmin((alpha * alpha).sum(axis=0) / sum_star))
        s_slot, e_slot = (s[slot], e[slot]) if slot < n else (1.0, -1.0)
        Q_star = e * (e_slot / gamma)
        D = Q_star + s * (r * s_slot)
        Q_new = -e_slot / gamma
        D_new = Q_new + r * s_slot
        if slot < n:
            Q_column, C_column = self._column(self.Q, slot), self._column(self.C, slot)
            Q_star += Q_column
            D += Q_column + C_column
            self.C[slot, :] = self.C[:, slot] = self.Q[slot, :] = self.Q[:, slot] = 0.0
            s[slot], e[slot], Q_star[slot], D[slot] = 1.0, -1.0, Q_new, D_new
        weights = alpha[:, slot] / sum_star[slot]
        self.alpha = alpha[:, :n]
        if slot < n:
            self.alpha[:, slot] = q
            self.basis[:, :, slot] = self.window.scaled
        self.alpha -= np.outer(weights, D)
        dsyr(r, s, lower=1, a=self.C, overwrite_a=1)
        dsyr(1.0 / q_star[slot], Q_star, lower=1, a=self.C, overwrite_a=1)
        dsyr(-1.0 / sum_star[slot], D, lower=1, a=self.C, overwrite_a=1)
        if slot < n:
            dsyr(1.0 / gamma, e, lower=1, a=self.Q, overwrite_a=1)
            dsyr(-1.0 / q_star[slot], Q_star, lower=1, a=self.Q, overwrite_a=1)
        return slot

    @staticmethod
    def _column(matrix: np.ndarray, slot: int) -> np.ndarray:
        return np.concatenate([matrix[slot, :slot], matrix[slot:, slot]])
