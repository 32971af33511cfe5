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
"""How far ahead on the centreline the demonstrator aims, m."""

GAIN = 2.5
"""Turn rate per radian of direction error, 1/s: firm."""

SLOWEST, FASTEST = 0.05, 0.35
"""Speeds in a turn, m/s."""

MARGIN = 0.1
"""Distance to obstacles below which the demonstrator slows down, m."""

FIRMLY = 2.0
"""In a full turn the intention is beyond the stick's end, so that it does not tremble."""

PATIENCE = 1.0
"""The demonstrator tries something else when the chair cannot move for longer than this, s."""

LAG, NOISE = 0.12, 0.06
"""Of a person's stick: its time constant in s, and the noise as a share of the deflection."""


class CornerSteering:
    """One intervention: the same style every time, with a person's noise.

    Parameters
    ----------
    line
        The course's centreline.
    corner
        The corner to get through.
    raster
        Where obstacles are.
    rng
        Random numbers of the stick.
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
        self._stick = Stick(LAG, NOISE, rng)
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
        wanted, error = self._wanted(sight, arc)
        # A shadow's command moves nothing: only the one who drives can be stuck.
        if sight.helped:
            free = self._recovery.movement(sight, wanted, error)
            if free is not None:
                return self._stick.move(free, passed)
        field = scan_field(sight.ranges, sight.bearings, sight.laser, LASER_RANGE)
        careful = slowed(field, wanted, MARGIN)
        firm = FIRMLY if abs(careful.w) == MAX_TURN_RATE else 1.0
        return self._stick.move(Command(careful.v, firm * careful.w), passed)

    def _wanted(self, sight: Sight, arc: float) -> tuple[Command, float]:
        """Return the command for a free floor, and the direction error."""
        aim = self._line.point(arc + AHEAD)
        towards = math.atan2(aim.y - sight.pose.y, aim.x - sight.pose.x)
        error = math.remainder(towards - sight.pose.heading, math.tau)
        w = min(max(GAIN * error, -MAX_TURN_RATE), MAX_TURN_RATE)
        return Command(self._speed, w), error
