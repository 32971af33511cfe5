"""The chair's outline covered by discs: a safe and quick replacement of the rectangle."""

import math

import numpy as np
from numpy.typing import NDArray

from protocols.wheelchair import FRONT, REAR, WIDTH

ROWS, COLUMNS = 4, 2
"""How many discs there are along and across the chair."""

DISC_RADIUS = math.hypot((FRONT + REAR) / ROWS, WIDTH / COLUMNS) / 2
"""Each disc just covers its share of the rectangle, m; none reaches farther than this past it."""


def disc_centres() -> NDArray[np.float64]:
    """Return the discs' centres in the chair's frame: shape (8, 2), x ahead, y to the left, m."""
    along = -REAR + (np.arange(ROWS) + 0.5) * (FRONT + REAR) / ROWS
    across = -WIDTH / 2 + (np.arange(COLUMNS) + 0.5) * WIDTH / COLUMNS
    return np.array([(x, y) for x in along for y in across])


SWING = float(np.hypot(*disc_centres().T).max())
"""Distance of the outermost disc centre from the middle of the axle, m."""
