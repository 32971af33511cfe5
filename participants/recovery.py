"""Getting free: notice that the chair is stuck, look around, and try a small movement."""

import math
from collections.abc import Callable, Sequence

from lad.command import Command
from participants.planning.field import DistanceField
from participants.planning.surroundings import map_field
from participants.planning.sweep import sweep
from participants.sight import Sight
from protocols.course.occupancy import Occupancy
from protocols.pose import Pose
from protocols.wheelchair import MAX_TURN_RATE

MOVING = 0.03
"""Velocities below this count as standing, m/s and rad/s."""

PLACE, WAY = 0.25, 0.6
"""A chair that has moved farther than this, m, or turned by more, rad, is in another place."""

LINGERING = 12.0
"""A driver who wants to move but stays in one place for longer is stuck, too, s."""

LONGEST, SHORTEST = 1.5, 0.5
"""How long a movement is tried, s."""

MOVEMENTS = tuple(
    Command(v, share * MAX_TURN_RATE)
    for v in (-0.2, 0.0, 0.15)
    for share in (-1.0, -0.5, 0.0, 0.5, 1.0)
    if (v, share) != (0.0, 0.0)
)
"""The movements to try, m/s and rad/s."""

REVERSING = 0.3
"""How much the score of a movement backwards is reduced."""


class Recovery:
    """One lap's attempts of one driver to get free.

    Each movement is tried once at one place, the most promising first; then all are tried again.

    Parameters
    ----------
    raster
        Where obstacles are: people look over their shoulder, a navigation stack has a map.
    patience
        A driver who wants to move but stands for longer is stuck, s.
    """

    def __init__(self, raster: Occupancy, patience: float) -> None:
        self._raster = raster
        self._patience = patience
        self._t: float | None = None
        self._place: Pose | None = None
        self._standing = 0.0
        self._lingering = 0.0
        self._tried: list[Command] = []
        self._until = -math.inf

    def movement(
        self,
        sight: Sight,
        wanted: Command,
        error: float,
        obeys: Callable[[float], float] = lambda _: 1.0,
    ) -> Command | None:
        """Return the movement to try now; None while the chair is not stuck.

        Parameters
        ----------
        sight
            What there is to see now.
        wanted
            What the driver wants it to do when nothing is in the way.
        error
            Direction to where the driver wants to go, as seen from the chair, rad.
        obeys
            The share of a turn rate that the driver believes the chair turns.
        """
        self._notice(sight, wanted)
        if sight.t < self._until:
            return self._tried[-1]
        if self._standing <= self._patience and self._lingering <= LINGERING:
            return None
        if len(self._tried) == len(MOVEMENTS):
            self._tried.clear()
        field = map_field(self._raster, sight.pose)
        movement, seconds = _most_promising(field, error, obeys, self._tried)
        self._tried.append(movement)
        self._until = sight.t + seconds
        self._standing = self._lingering = 0.0
        return movement

    def helped(self) -> None:
        """Forget all attempts: the assistant moves the chair."""
        self._standing = self._lingering = 0.0
        self._tried.clear()
        self._until = -math.inf
        self._t = None

    def _notice(self, sight: Sight, wanted: Command) -> None:
        passed = 0.0 if self._t is None else sight.t - self._t
        self._t = sight.t
        if self._place is None or _elsewhere(self._place, sight.pose):
            self._place = sight.pose
            self._lingering = 0.0
            self._tried = self._tried[-1:] if sight.t < self._until else []
        willing = _size(wanted) > MOVING
        stands = willing and _size(sight.velocity) < MOVING
        self._standing = self._standing + passed if stands else 0.0
        self._lingering += passed * willing


def _most_promising(
    field: DistanceField,
    error: float,
    obeys: Callable[[float], float],
    tried: Sequence[Command],
) -> tuple[Command, float]:
    """Return a movement that has not been tried yet, and for how many seconds to do it."""
    best, best_time, best_score = MOVEMENTS[0], SHORTEST, -math.inf
    for movement in MOVEMENTS:
        if movement in tried:
            continue
        expected = Command(movement.v, movement.w * obeys(movement.w))
        found = sweep(field, expected, LONGEST)
        closer = abs(error) - abs(error - expected.w * found.time)
        score = closer + 0.5 * found.time + found.room - REVERSING * (movement.v < 0)
        if score > best_score:
            best, best_time, best_score = movement, max(found.time, SHORTEST), score
    return best, best_time


def _elsewhere(before: Pose, now: Pose) -> bool:
    turned = abs(math.remainder(now.heading - before.heading, math.tau))
    return math.hypot(now.x - before.x, now.y - before.y) > PLACE or turned > WAY


def _size(command: Command) -> float:
    return max(abs(command.v), abs(command.w))
