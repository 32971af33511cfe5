"""How a person slows down for obstacles in the way."""

import math

from lad.command import Command
from participants.planning.field import DistanceField
from participants.planning.sweep import sweep

HORIZON = 3.0
"""How far ahead a person looks along the intended way, s."""

NEAR = 1.0
"""A person slows down for narrow places this long before reaching them, s."""

STOPPING = 0.4
"""How hard a person is ready to brake, m/s^2."""

GAP = 0.05
"""How far before an obstacle a person wants to stop, m."""

CREEP = 0.08
"""The least speed past an obstacle, m/s."""


def slowed(field: DistanceField, intention: Command, clearance: float) -> Command:
    """Return the intention at a speed that suits what the scan shows.

    Parameters
    ----------
    field
        Distance field of the scan.
    intention
        What the chair is expected to do, m/s and rad/s.
    clearance
        Distance to obstacles below which the person slows down, m.
    """
    if intention.v <= 0.0:
        return intention
    calm = intention.v * min(sweep(field, intention, NEAR).room / clearance, 1.0)
    ahead = sweep(field, intention, HORIZON).time
    distance = max(ahead * intention.v - GAP, 0.0)
    stopping = math.inf if ahead >= HORIZON else math.sqrt(2.0 * STOPPING * distance)
    return Command(min(intention.v, max(calm, CREEP), stopping), intention.w)
