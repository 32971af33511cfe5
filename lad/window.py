"""The state of the model: the current input and its recent past, newest first."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lad.errors import InvalidInputError


@dataclass
class Window:
    """The last tau inputs in units of their lengthscales; zeros stand for missing ones.

    Classifier and regressor may share one window: it holds nothing either of them has learnt.

    Attributes
    ----------
    scaled
        Shape (tau, d): inputs over lengthscales, newest first.
    time
        How many inputs came before the newest one since the model was made; -1 before the first.
    lap
        Which lap the newest input belongs to, from 0; a reset after at least one input counts.
    seen
        How many inputs this lap has shown so far.
    version
        Changes whenever the contents do.
    """

    lengthscales: NDArray[np.float64]
    depth: int
    scaled: NDArray[np.float64] = field(init=False)
    time: int = field(default=-1, init=False)
    lap: int = field(default=0, init=False)
    seen: int = field(default=0, init=False)
    version: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        self.lengthscales = np.array(self.lengthscales, dtype=np.float64)
        self.scaled = np.zeros((self.depth, self.lengthscales.size))

    def observe(self, x: NDArray[np.float64]) -> None:
        """Push one input, dropping the oldest.

        Parameters
        ----------
        x
            Shape (d,), finite, in the units of the lengthscales.

        Raises
        ------
        InvalidInputError
            When x has another shape or type, or a value that is not finite; nothing has changed.
        """
        scaled = as_vector(x, self.lengthscales.size, "input", InvalidInputError)
        scaled = scaled / self.lengthscales
        if not np.isfinite(scaled).all():
            message = "input: too large in units of its lengthscale; allowed below 1e308 of them"
            raise InvalidInputError(message)
        self.scaled[1:] = self.scaled[:-1]
        self.scaled[0] = scaled
        self.time += 1
        self.seen += 1
        self.version += 1

    def reset(self) -> None:
        """Start a new lap: the past becomes zeros again."""
        if self.seen:
            self.lap += 1
        self.scaled[:] = 0.0
        self.seen = 0
        self.version += 1

    @property
    def inputs(self) -> NDArray[np.float64]:
        """Shape (tau, d): the window in the inputs' own units, newest first."""
        return np.asarray(self.scaled * self.lengthscales)


def as_vector(value: object, size: int, name: str, error: type[ValueError]) -> NDArray[np.float64]:
    """Check that a value is a finite float vector of the right length.

    Parameters
    ----------
    value
        What was given: an array or a sequence of real numbers, shape (size,).
    size
        The length it must have.
    name
        What to call it in the message.
    error
        The error to raise: shape, type and content are named in its one line.
    """
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise error(f"{name}: given dtype {array.dtype}; allowed are real numbers")
    if array.shape != (size,):
        raise error(f"{name}: given shape {array.shape}; allowed is ({size},)")
    array = array.astype(np.float64, copy=False)
    if not np.isfinite(array).all():
        bad = np.flatnonzero(~np.isfinite(array))
        raise error(f"{name}: given {array[bad[0]]} at index {bad[0]}; allowed are finite numbers")
    return array
