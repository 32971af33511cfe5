"""How a demonstrator steers a wheelchair through a corner."""

import math

import numpy as np

from lad.command import Command
from participants.human.caution import slowed
from participants.human.stick import Stick
from participants.planning.field import scan_field
from participants.recovery import Recovery
from participants.sight import Sight
from protocols.course.centreline import Centreline, Stretch
from protocols.course.occupancy import Occupancy
from protocols.wheelchair import LASER_RANGE, MAX_TURN_RATE

AHEAD = 0.8
"""How far ahead on the centreline one steers, m."""

GAIN = 2.5
"""Turn rate per radian of direction error, 1/s: firm."""

SLOWEST, FASTEST = 0.05, 0.35
"""Speeds in a turn, m/s."""

MARGIN = 0.1
"""Room below which one slows down, m."""

FIRMLY = 2.0
"""A full turn is pushed for beyond the stick's end, so that it does not tremble."""

PATIENCE = 1.0
"""Standing still against its will for longer makes it try something else, s."""

LAG, NOISE = 0.12, 0.06
"""Those of a person's hand: the stick's time constant in s, and the noise's share."""


class CornerSteering:
    """One intervention: the same style every time, with a person's noise.

    Parameters
    ----------
    line
        The course's centreline.
    corner
        The corner to get through.
    raster
        What stands where.
    rng
        Random numbers of the hand.
    pace
        Share of the speed at which the corner could just be driven.
    """

    def __init__(
        self,
        line: Centreline,
        corner: Stretch,
        raster: Occupancy,
        rng: np.random.Generator,
        pace: float = 1.0,
    ) -> None:
        self._line = line
        turn = line.point(corner.end).heading - line.point(corner.start).heading
        radius = (corner.end - corner.start) / max(abs(math.remainder(turn, math.tau)), 0.1)
        # The chair turning as fast as it can just follows the corner at this speed.
        self._speed = min(max(pace * radius * MAX_TURN_RATE, SLOWEST), FASTEST)
        self._hand = Stick(LAG, NOISE, rng)
        self._recovery = Recovery(raster, PATIENCE)
        self._t: float | None = None

    def steer(self, sight: Sight, arc: float) -> Command:
        """Return the command of the moment.

        Parameters
        ----------
        sight
            What there is to see.
        arc
            Where the chair is on the centreline, m.
        """
        passed = LAG if self._t is None else sight.t - self._t
        self._t = sight.t
        wish, error = self._wish(sight, arc)
        # A shadow's will moves nothing: only who drives can be stuck.
        if sight.helped:
            free = self._recovery.movement(sight, wish, error)
            if free is not None:
                return self._hand.move(free, passed)
        field = scan_field(sight.ranges, sight.bearings, sight.laser, LASER_RANGE)
        careful = slowed(field, wish, MARGIN)
        firm = FIRMLY if abs(careful.w) == MAX_TURN_RATE else 1.0
        return self._hand.move(Command(careful.v, firm * careful.w), passed)

    def _wish(self, sight: Sight, arc: float) -> tuple[Command, float]:
        """Return what it would have the chair do on a free floor, and the direction error."""
        aim = self._line.point(arc + AHEAD)
        towards = math.atan2(aim.y - sight.pose.y, aim.x - sight.pose.x)
        error = math.remainder(towards - sight.pose.heading, math.tau)
        w = min(max(GAIN * error, -MAX_TURN_RATE), MAX_TURN_RATE)
        return Command(self._speed, w), error
