"""The paper's RD: drives along a planned path by the Dynamic Window Approach (section IV.A)."""

import math

import numpy as np

from lad.command import STILL, Command
from participants.dwa import DynamicWindow, choose
from participants.options import NoOptions, read_options
from participants.planning.field import scan_field
from participants.planning.route import Route, plan
from participants.setup import DriverSetup
from participants.sight import Sight
from participants.standstill import Standstill

LASER_RANGE = 4.0
"""Returns from here on are none, m."""

PATIENCE = 1.0
"""Standing still against its will for longer makes it back up, s."""

BACKING = Command(-0.15, 0.0)
"""How it backs up, m/s and rad/s."""

BACKING_TIME = 1.5
"""For how long, s."""


class AutonomousDriver:
    """A navigation stack with a map and a laser.

    It plans anew in every step from what it sees, and does not know that its commands may be
    scaled behind its back. Blocked, it backs up a little, as navigation stacks do.

    Parameters
    ----------
    route
        The global path.
    window
        Settings of the local planner.
    lookahead
        How far ahead on the path the local planner's target lies, m.
    """

    def __init__(
        self, route: Route, window: DynamicWindow | None = None, lookahead: float = 0.9
    ) -> None:
        self._route = route
        self._window = window if window is not None else DynamicWindow()
        self._lookahead = lookahead
        self._arc: float | None = None
        self._standstill = Standstill()
        self._backing_until = -math.inf

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:  # noqa: ARG002  # the seam's
        """Look for itself on the path anew."""
        self._arc = None
        self._standstill = Standstill()
        self._backing_until = -math.inf

    def act(self, sight: Sight) -> Command:
        """Choose the best velocities towards a point ahead on the path."""
        if sight.t < self._backing_until:
            return BACKING
        target = self._target(sight)
        field = scan_field(sight.ranges, sight.bearings, sight.laser, LASER_RANGE)
        choice = choose(field, sight.velocity, target, self._window)
        # Wanting to move and finding nothing admissible is standing against one's will, too.
        wish = choice.command if math.isfinite(choice.score) else BACKING
        if self._standstill.notice(sight.t, sight.velocity, wish) > PATIENCE:
            self._standstill = Standstill()
            self._backing_until = sight.t + BACKING_TIME
            return BACKING
        return choice.command if math.isfinite(choice.score) else STILL

    def _target(self, sight: Sight) -> tuple[float, float]:
        """Return the point ahead on the path in the chair's frame, m."""
        arc = self._route.locate(sight.pose, sight.gates_passed, self._arc).arc
        self._arc = arc
        aim = self._route.point(arc + self._lookahead)
        dx, dy = aim.x - sight.pose.x, aim.y - sight.pose.y
        c, s = math.cos(sight.pose.heading), math.sin(sight.pose.heading)
        return c * dx + s * dy, c * dy - s * dx


def autonomous_driver(setup: DriverSetup) -> AutonomousDriver:
    """Return the autonomous driver for a course; it takes no options."""
    read_options("driver 'autonomous'", NoOptions, setup.options)
    return AutonomousDriver(plan(setup.course))
