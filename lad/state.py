"""What a process has learnt, in arrays with room to grow."""

from dataclasses import dataclass, field

import numpy as np

from lad.triangle import aligned_zeros, padded, row_starts, triangle_zeros
from lad.window import Window

FIRST_ROOM = 32
WORK_ROWS = 5


@dataclass
class State:
    """Basis vectors and the natural parameters of the process over them.

    Room doubles until it holds capacity + 1 (a new vector is stored after the old ones before one
    is deleted), then memory is constant.

    Attributes
    ----------
    n
        Number of basis vectors in use; the arrays below have room for more.
    C, Q
        Lower triangles (``lad.triangle``), of which the first n rows count.
    starts
        Shape (room,): where the rows of C and Q begin.
    alpha
        Shape (p, room).
    basis
        Shape (tau, d, room): windows in units of the lengthscales, newest input first.
    times, laps
        Shape (room,): when each basis vector was seen.
    work
        Shape (5, room): vectors of the step in progress.
    """

    depth: int
    n_inputs: int
    n_outputs: int
    capacity: int
    n: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        self._allocate(min(FIRST_ROOM, self._most))

    def _allocate(self, room: int) -> None:
        self.C = triangle_zeros(room)
        self.Q = triangle_zeros(room)
        self.starts = row_starts(room)
        self.alpha = aligned_zeros(self.n_outputs, room)
        self.basis = aligned_zeros(self.depth, self.n_inputs, room)
        self.times = np.zeros(room, dtype=np.int64)
        self.laps = np.zeros(room, dtype=np.int64)
        self.work = aligned_zeros(WORK_ROWS, room)

    @property
    def _most(self) -> int:
        return padded(self.capacity + 1)

    @property
    def room(self) -> int:
        """How many basis vectors the arrays can hold."""
        return int(self.alpha.shape[1])

    def make_room(self) -> None:
        """Make room for one vector more than there are, keeping everything, work included."""
        if self.n < self.room:
            return
        old = (self.C, self.Q, self.alpha, self.basis, self.times, self.laps, self.work)
        self._allocate(min(2 * self.room, self._most))
        new = (self.C, self.Q, self.alpha, self.basis, self.times, self.laps, self.work)
        for before, after in zip(old, new, strict=True):
            after[tuple(slice(size) for size in before.shape)] = before

    def remember(self, window: Window, slot: int) -> None:
        """Store the window as the basis vector of a slot."""
        self.basis[:, :, slot] = window.scaled
        self.times[slot] = window.time
        self.laps[slot] = window.lap
