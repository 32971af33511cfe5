"""How far Q is from the inverse of the kernel matrix, watched cheaply and repaired.

Every full update and deletion adds rounding errors to Q, more of them the more alike the basis
vectors are: on smooth, noise-free inputs |QK - I| reaches 0.08 without repairs. One column of
QK - I costs about as much as a prediction; the column looked at belongs to the vector with the
largest Q_jj k(b_j, x) for the input x just learnt, which carries nearly all of the error that the
step has made.
"""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from lad import fused
from lad.inverse import invert
from lad.state import State
from lad.triangle import Vector, aligned_zeros, row_of
from lad.update import SMALLEST_NOVELTY

LARGEST_RESIDUAL = 1e-6
LIMIT = LARGEST_RESIDUAL / 10.0
"""A tenth, because the one column looked at represents all the others."""

LEAST_RISK = 1.0 / 16.0
RISKY_NOVELTY = 3e-3
ROUND_EVERY = 8
"""Every eighth check includes one more column, in turn, so that each is checked at some time."""


@dataclass
class Health:
    """The watch over one process.

    Attributes
    ----------
    residual
        Largest entry of the column (or two) of |QK - I| looked at last.
    limit
        Residual of that column at which Q is recomputed: a tenth of 1e-6, or ten times what the
        last repair could reach where the kernel matrix is so ill-conditioned that float64 cannot
        do better.
    probes
        How often a column was looked at.
    repairs
        How often Q was recomputed by factorising the kernel matrix.
    recoveries
        How often a posterior with a negative variance was rebuilt (``lad.recovery``): 0 with
        Table I, and with any noise that is not tiny.
    risk
        Sum, since the last look, of a weight per change of Q: at least 1/16, and 1 when the
        novelty was 3e-3 or less (the error of a full update grows with 1 / gamma). The next look
        is due at 1.
    """

    residual: float = 0.0
    limit: float = LIMIT
    probes: int = 0
    repairs: int = 0
    recoveries: int = 0
    risk: float = 0.0

    def to_header(self) -> dict[str, Any]:
        """Give the numbers to a saved model."""
        return asdict(self)


@dataclass(frozen=True)
class KernelMatrix:
    """The kernel matrix of the basis vectors, a column at a time."""

    state: State
    inverse_scale: float
    signal_variance: float
    constant_variance: float = 0.0

    @property
    def prior(self) -> float:
        """k(x, x), every entry of its diagonal."""
        return self.signal_variance + self.constant_variance

    def column(self, slot: int, n: int, out: Vector, scratch: Vector) -> None:
        """Covariance of a basis vector with the first n, into ``out``."""
        window = np.ascontiguousarray(self.state.basis[:, :, slot])
        fused.kernel_vector(
            self.state.basis,
            window,
            n,
            self.inverse_scale,
            self.signal_variance,
            self.constant_variance,
            out,
            scratch,
        )

    def residual_of_column(self, slot: int) -> float:
        """Largest entry of one column of |QK - I|."""
        n = self.state.n
        k, product = aligned_zeros(2, self.state.room)
        self.column(slot, n, k, product)
        fused.symmetric_product(self.state.Q, self.state.starts, k, n, product)
        product[slot] -= 1.0
        return float(np.abs(product[:n]).max())

    def residual(self) -> float:
        """Largest entry of |QK - I|, every column: exact, at the price of n predictions."""
        return max((self.residual_of_column(slot) for slot in range(self.state.n)), default=0.0)

    def fill(self, triangle: Vector, extra: float = 0.0) -> None:
        """Write K + extra I into a lower triangle."""
        k, scratch = aligned_zeros(2, self.state.room)
        for slot in range(self.state.n):
            self.column(slot, slot + 1, k, scratch)
            k[slot] += extra
            row_of(triangle, self.state.starts, slot)[:] = k[: slot + 1]

    def invert_into_Q(self) -> None:  # noqa: N802  # Q is the mathematics' own name
        """Recompute Q from the kernel matrix; C and alpha do not depend on its errors."""
        self.fill(self.state.Q)
        invert(self.state.Q, self.state.starts, self.state.n, SMALLEST_NOVELTY)


def watch(health: Health, matrix: KernelMatrix, new: int, novelty: float) -> None:
    """Check a column, when it is due, after a step that changed Q; repair a residual too large.

    Parameters
    ----------
    health
        Updated in place.
    matrix
        The kernel matrix; row 0 of its state's ``work`` still holds k of the input just learnt.
    new
        Slot of the new basis vector.
    novelty
        gamma / k(x, x) of that input.
    """
    health.risk += max(LEAST_RISK, min(1.0, RISKY_NOVELTY / novelty))
    if health.risk < 1.0:
        return
    health.risk = 0.0
    health.probes += 1
    state = matrix.state
    slot = fused.likeliest_wrong(state.n, new, state.Q, state.starts, state.work)
    health.residual = matrix.residual_of_column(slot)
    if health.probes % ROUND_EVERY == 0:
        other = matrix.residual_of_column(health.probes // ROUND_EVERY % state.n)
        health.residual = max(health.residual, other)
    if not health.residual <= health.limit:  # NaN counts as too large
        repair(health, matrix)
        health.residual = matrix.residual_of_column(slot)
        health.limit = max(LIMIT, 10.0 * health.residual)


def repair(health: Health, matrix: KernelMatrix) -> None:
    """Recompute Q, and count it."""
    matrix.invert_into_Q()
    health.repairs += 1
