"""The state of the model: the current input and its recent past, newest first."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled
from lad.errors import HyperparameterError, InvalidInputError

LARGEST_INPUT = 1e150
"""In lengthscales: squared distances then stay finite."""


@dataclass
class Window:
    """The last tau inputs in units of their lengthscales; zeros replace missing ones.

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
        self._largest = LARGEST_INPUT * self.lengthscales
        self.scaled = np.zeros((self.depth, self.lengthscales.size))

    def check_fits(self, lengthscales: Sequence[float], depth: int) -> None:
        """Raise a HyperparameterError unless this is the window such a process looks at."""
        if depth != self.depth or not np.array_equal(lengthscales, self.lengthscales):
            raise HyperparameterError(
                f"window: given one of depth {self.depth} and lengthscales "
                f"{self.lengthscales.tolist()}; allowed is the process's own depth {depth} and "
                f"lengthscales {list(lengthscales)}"
            )

    def check(self, x: object) -> NDArray[np.float64]:
        """Return x as floats, shape (d,), or raise what ``observe`` would raise."""
        vector = as_vector(x, self.lengthscales.size, "input", InvalidInputError)
        if not _allowed(vector, self._largest):
            _refuse(vector, self._largest)
        return vector

    def observe(self, x: object) -> None:
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
        _push(self.scaled, self.check(x), self.lengthscales)
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

    def show(self, inputs: NDArray[np.float64], time: int, lap: int) -> None:
        """Show a whole window that was seen at another time.

        Parameters
        ----------
        inputs
            Shape (tau, d), in the inputs' own units, as ``inputs`` was then.
        time, lap
            When that was.
        """
        self.scaled[:] = inputs / self.lengthscales
        self.time, self.lap, self.seen = time, lap, 1
        self.version += 1

    def start_at(self, time: int, lap: int) -> None:
        """Stand at the start of a lap, after so many inputs."""
        self.reset()
        self.time, self.lap = time, lap

    @property
    def inputs(self) -> NDArray[np.float64]:
        """Shape (tau, d): the window in the inputs' own units, newest first."""
        return np.asarray(self.scaled * self.lengthscales)


@compiled
def _allowed(vector: Any, largest: Any) -> Any:
    within = 0
    for i in range(len(vector)):
        within += abs(vector[i]) <= largest[i]  # NaN is no smaller either
    return within == len(vector)


@compiled
def _push(scaled: Any, vector: Any, lengthscales: Any) -> None:
    for lag in range(len(scaled) - 1, 0, -1):
        for i in range(len(vector)):
            scaled[lag, i] = scaled[lag - 1, i]
    for i in range(len(vector)):
        scaled[0, i] = vector[i] / lengthscales[i]


def as_vector(value: object, size: int, name: str, error: type[ValueError]) -> NDArray[np.float64]:
    """Check the type and the length of a vector; its values are the caller's business.

    Parameters
    ----------
    value
        What was given: an array or a sequence of real numbers, shape (size,).
    size
        The length it must have.
    name
        What to call it in the message.
    error
        The error to raise, with one line: what was given and what is allowed.
    """
    try:
        array = np.asarray(value)
    except ValueError:  # rows of unequal length
        array = np.array(None)
    if array.dtype.kind not in "fiu":
        raise error(f"{name}: given {_described(value, array)}; allowed are {size} real numbers")
    if array.shape != (size,):
        raise error(f"{name}: given shape {array.shape}; allowed is ({size},)")
    return np.ascontiguousarray(array, dtype=np.float64)


def _described(value: object, array: NDArray[Any]) -> str:
    """Name the type of what is not a vector of numbers."""
    return f"dtype {array.dtype}" if isinstance(value, np.ndarray) else type(value).__name__


def _refuse(x: NDArray[np.float64], largest: NDArray[np.float64]) -> NoReturn:
    """Raise an error that names the value that is not finite, or too large."""
    index = int(np.flatnonzero(~(np.abs(x) <= largest))[0])
    raise InvalidInputError(
        f"input: given {x[index]} at index {index}; allowed are finite numbers up to "
        f"{LARGEST_INPUT:g} lengthscales"
    )
