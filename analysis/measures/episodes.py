"""Unbroken stretches of a signal that is on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Episode(NamedTuple):
    """Steps start to stop - 1, during which the signal was on without a break."""

    start: int
    stop: int


def episodes(on: NDArray[np.bool_]) -> list[Episode]:
    """Return the unbroken stretches of True, in order.

    Examples
    --------
    >>> import numpy as np
    >>> episodes(np.array([False, True, True, False, True]))
    [Episode(start=1, stop=3), Episode(start=4, stop=5)]
    """
    edges = np.diff(np.concatenate([[0], on.astype(np.int8), [0]]))
    starts, stops = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [Episode(int(a), int(b)) for a, b in zip(starts, stops, strict=True)]
