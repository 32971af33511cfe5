"""Getting free: look around, choose a small movement, and carry it out."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from participants.human.authority import Authority
from participants.planning.sweep import sweep
from protocols.wheelchair import MAX_TURN_RATE

LONGEST = 1.5
"""How long a movement lasts at most, s."""

SPEEDS = (-0.2, 0.0, 0.15)
TURNS = (-1.0, -0.5, 0.0, 0.5, 1.0)
"""Movements that come to mind: speeds in m/s, and shares of full deflection."""

REVERSING = 0.3
"""How much room ahead must gain from reversing before one reverses, as a score."""


@dataclass(frozen=True, slots=True)
class Manoeuvre:
    """A movement: what to do, and for how many seconds."""

    command: Command
    seconds: float


def get_free(
    field: NDArray[np.float64], error: float, authority: Authority, tried: Command
) -> Manoeuvre:
    """Return the movement that promises most.

    Parameters
    ----------
    field
        Distance field of the surroundings: people look over their shoulder.
    error
        Direction to where one wants to go, rad.
    authority
        How far the chair obeys.
    tried
        What has just not worked; its like is left out.
    """
    best, promise = Manoeuvre(Command(SPEEDS[0], 0.0), LONGEST), -np.inf
    for v in SPEEDS:
        for share in TURNS:
            w = share * MAX_TURN_RATE
            if (v == 0.0 and w == 0.0) or _alike(Command(v, w), tried):
                continue
            expected = Command(v, w * authority.of(w))
            found = sweep(field, expected, LONGEST)
            closer = abs(error) - abs(error - expected.w * found.time)
            score = closer + 0.5 * found.time + found.room - REVERSING * (v < 0)
            if score > promise:
                best, promise = Manoeuvre(Command(v, w), max(found.time, 0.5)), score
    return best


def _alike(one: Command, other: Command) -> bool:
    return bool(np.sign(one.v) == np.sign(other.v) and np.sign(one.w) == np.sign(other.w))
