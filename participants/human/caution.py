"""How a person slows down for what stands in the way."""

import math

from lad.command import Command
from participants.planning.field import DistanceField
from participants.planning.sweep import sweep

HORIZON = 3.0
"""How far ahead one looks along the way one is about to go, s."""

NEAR = 1.0
"""Narrow places count from this time before one is there, s."""

STOPPING = 0.4
"""How hard one is ready to brake, m/s^2."""

GAP = 0.05
"""Where one wants to stop before an obstacle, m."""

CREEP = 0.08
"""Nobody goes slower than this past an obstacle, m/s."""


def slowed(field: DistanceField, intention: Command, clearance: float) -> Command:
    """Return the intention at a speed that suits what the scan shows.

    Parameters
    ----------
    field
        Distance field of the scan.
    intention
        What the chair is expected to do, m/s and rad/s.
    clearance
        Room below which one slows down, m.
    """
    if intention.v <= 0.0:
        return intention
    calm = intention.v * min(sweep(field, intention, NEAR).room / clearance, 1.0)
    ahead = sweep(field, intention, HORIZON).time
    distance = max(ahead * intention.v - GAP, 0.0)
    stopping = math.inf if ahead >= HORIZON else math.sqrt(2.0 * STOPPING * distance)
    return Command(min(intention.v, max(calm, CREEP), stopping), intention.w)
