"""Where the wheelchair is."""

from typing import NamedTuple


class Pose(NamedTuple):
    """A pose on the floor plan: metres, and radians anticlockwise from the x axis.

    The reference point is the midpoint of the driven axle.
    """

    x: float
    y: float
    heading: float
