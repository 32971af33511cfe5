"""STORK-GP: the sparse online Gaussian process with a recursive kernel, as people use it."""

from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lad import fused
from lad.health import Health, KernelMatrix, repair, watch
from lad.hyperparameters import GPHyperparameters
from lad.likelihood import LikelihoodName, check_outputs, check_target, evidence
from lad.model_file import pack, read, rebuilding, unpack, write_whole
from lad.posterior import Posterior
from lad.recovery import is_possible, rebuild
from lad.snapshot import restore_state, restore_window, state_arrays, window_arrays
from lad.state import State
from lad.triangle import whole
from lad.update import SMALLEST_NOVELTY, SMALLEST_VARIANCE, Prediction, Update, UpdateKind
from lad.window import Window

KIND = "stork-gp"


class StorkGP:
    """Spatio-temporal online recursive kernel Gaussian process.

    Looking and learning are apart: ``observe`` advances the window once per step, ``predict`` and
    ``learn`` use the current window, ``reset_window`` starts a lap and forgets nothing that
    was learnt.

    Parameters
    ----------
    hyperparameters
        Checked hyperparameters.
    likelihood
        ``gaussian`` for regression, ``probit`` for labels -1 and +1.
    n_outputs
        Number of outputs p; they share C, Q and the basis vectors. A classifier has one.
    window
        A window to share with another process (only one of the two calls ``observe``).

    Attributes
    ----------
    health
        The watch over |QK - I|: last residual, probes and repairs.

    Raises
    ------
    HyperparameterError
        When the likelihood is unknown, or has not that many outputs, or a shared window has other
        lengthscales or another depth.

    References
    ----------
    Soh & Demiris, When and how to help, section III. Csato & Opper, Sparse on-line Gaussian
    processes, Neural Computation 14, 2002.

    Examples
    --------
    >>> gp = StorkGP(GPHyperparameters(lengthscales=[0.5], noise_variance=0.01))
    >>> gp.observe([0.3])
    >>> gp.learn([1.0]).kind.name
    'FIRST'
    >>> float(gp.predict().mean[0].round(4))
    0.9091
    """

    def __init__(
        self,
        hyperparameters: GPHyperparameters,
        likelihood: LikelihoodName = "gaussian",
        n_outputs: int = 1,
        window: Window | None = None,
    ) -> None:
        check_outputs(likelihood, n_outputs)
        self.hyperparameters = hyperparameters
        self.likelihood = likelihood
        self.n_outputs = n_outputs
        self.window = window or Window(
            np.array(hyperparameters.lengthscales), hyperparameters.recursion_depth
        )
        self.window.check_fits(hyperparameters.lengthscales, hyperparameters.recursion_depth)
        self.state = State(
            depth=hyperparameters.recursion_depth,
            n_inputs=hyperparameters.n_inputs,
            n_outputs=n_outputs,
            capacity=hyperparameters.capacity,
        )
        self._signal = hyperparameters.signal_variance
        self._constant = hyperparameters.constant_variance
        self._prior = hyperparameters.prior_variance
        self._prior_mean = hyperparameters.prior_mean
        self._noise = hyperparameters.noise_variance
        self._inverse_scale = 1.0 / hyperparameters.squared_temporal_scale
        self._least_novel = max(hyperparameters.novelty * self._prior, SMALLEST_NOVELTY)
        self.health = Health()
        self._kernel_matrix = KernelMatrix(
            self.state, self._inverse_scale, self._signal, self._constant
        )
        self._mean = np.zeros(n_outputs)
        self._computed_latent = self._latent = 0.0
        self._looked_at = -1

    @property
    def n_basis(self) -> int:
        """Number of basis vectors n."""
        return self.state.n

    @property
    def times(self) -> NDArray[np.int64]:
        """Shape (n,): which input of the model's life each basis vector is, from 0."""
        return self.state.times[: self.state.n].copy()

    def posterior(self) -> Posterior:
        """Copy alpha (n, p), C (n, n) and Q (n, n); rows are in the order of ``times``."""
        state, n = self.state, self.state.n
        return Posterior(state.alpha[:, :n].T.copy(), whole(state.C, n), whole(state.Q, n))

    def observe(self, x: NDArray[np.float64]) -> None:
        """Advance the window by one input, shape (d,)."""
        self.window.observe(x)

    def reset_window(self) -> None:
        """Start a new lap."""
        self.window.reset()

    def _look(self) -> None:
        """Fill k, C k, mean and latent variance, unless they are those of this window already."""
        if self._looked_at == self.window.version:
            return
        state = self.state
        latent = fused.predict(
            state.n,
            state.C,
            state.starts,
            state.alpha,
            state.basis,
            state.work,
            self.window.scaled,
            self._inverse_scale,
            self._signal,
            self._constant,
            self._mean,
        )
        if self._prior_mean:
            self._mean += self._prior_mean
        self._computed_latent = latent
        self._latent = max(SMALLEST_VARIANCE, latent)  # in this order NaN gives way
        self._looked_at = self.window.version

    def predict(self) -> Prediction:
        """Predict at the current window: equations (8) and (9). Changes nothing."""
        self._look()
        return Prediction(self._mean.copy(), self._latent, self._latent + self._noise)

    def covariances(self) -> NDArray[np.float64]:
        """Shape (n,): k(b, x) of every basis vector and the current window."""
        self._look()
        return self.state.work[fused.K_ROW, : self.state.n].copy()

    def check(self, x: object, y: object | None = None) -> None:
        """Raise what ``observe`` and ``learn`` would raise, and change nothing."""
        self.window.check(x)
        if y is not None:
            check_target(y, self.n_outputs, self.likelihood)

    def residual(self) -> float:
        """Largest entry of |QK - I|, exactly: the price is one prediction per basis vector."""
        return self._kernel_matrix.residual()

    def repair(self) -> None:
        """Recompute Q from the kernel matrix, as the watch does when it must; counted."""
        repair(self.health, self._kernel_matrix)

    def learn(self, y: object) -> Update:
        """Learn the target of the current window.

        Parameters
        ----------
        y
            Shape (p,), or a plain number for one output; -1 or +1 for a classifier.

        Raises
        ------
        InvalidTargetError
            When y has another shape or type or is not finite; nothing has changed.
        """
        target = check_target(y, self.n_outputs, self.likelihood)
        self._look()
        if not is_possible(self._computed_latent, self._noise):
            self._recover()
        q, r = evidence(target, self._mean, self._latent + self._noise, self.likelihood)
        state = self.state
        state.make_room()
        self._looked_at = -1
        done, gamma, slot = fused.learn(
            state.n,
            state.capacity,
            state.C,
            state.Q,
            state.starts,
            state.alpha,
            state.work,
            self._prior,
            self._least_novel,
            q,
            r,
        )
        novelty = gamma / self._prior if gamma >= SMALLEST_NOVELTY else 0.0
        update = self._take_in(done, novelty, slot)
        if done != fused.SPARSE and slot < state.n:
            watch(self.health, self._kernel_matrix, slot, novelty)
        return update

    def _recover(self) -> None:
        """Rebuild an impossible posterior, and compute k and C k again."""
        rebuild(self._kernel_matrix, self._noise)
        self.health.recoveries += 1
        self._looked_at = -1
        self._look()

    def _take_in(self, done: int, novelty: float, slot: int) -> Update:
        """Keep the window where the step put the new basis vector, and return what happened."""
        state = self.state
        if done == fused.SPARSE:
            return Update(UpdateKind.SPARSE, novelty)
        if done == fused.FULL:
            state.remember(self.window, slot)
            state.n += 1
            return Update(UpdateKind.FIRST if state.n == 1 else UpdateKind.FULL, novelty)
        if slot == state.n:
            return Update(UpdateKind.FULL_THEN_DELETION, novelty, self.window.time)
        deleted = int(state.times[slot])
        state.remember(self.window, slot)
        return Update(UpdateKind.FULL_THEN_DELETION, novelty, deleted)

    def to_bytes(self) -> bytes:
        """Save as the bytes of one portable npz; the same bytes for the same model."""
        window, arrays = window_arrays(self.window)
        header = {
            "hyperparameters": self.hyperparameters.to_header(),
            "likelihood": self.likelihood,
            "n_outputs": self.n_outputs,
            "window": window,
            "health": self.health.to_header(),
        }
        return pack(KIND, header, arrays | state_arrays(self.state))

    @classmethod
    def from_bytes(cls, data: bytes, source: str = "model") -> Self:
        """Rebuild a process whose predictions are bit-identical.

        Raises
        ------
        ModelFileError
            When the bytes are not a saved process; ``source`` names them.
        """
        header, arrays = unpack(data, KIND, source)
        with rebuilding(source):
            hyper = GPHyperparameters.from_header(header["hyperparameters"])
            process = cls(hyper, header["likelihood"], header["n_outputs"])
            restore_window(process.window, header["window"], arrays)
            restore_state(process.state, arrays)
            process.health = Health(**header["health"])
        return process

    def save(self, path: str | Path) -> None:
        """Write ``to_bytes`` to a file, whole or not at all."""
        write_whole(path, self.to_bytes())

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Read what ``save`` wrote; a ModelFileError names the path."""
        return cls.from_bytes(read(path), str(path))

    def __reduce__(self) -> tuple[object, tuple[bytes]]:
        return type(self).from_bytes, (self.to_bytes(),)
