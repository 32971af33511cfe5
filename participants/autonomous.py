"""The paper's RD: drives along a planned path by the Dynamic Window Approach (section IV.A)."""

import math
from typing import Annotated

import numpy as np
from pydantic import Field

from lad.command import Command
from participants.dwa import DynamicWindow, choose
from participants.localisation import Localisation
from participants.options import Options, read_options
from participants.planning.field import scan_field
from participants.planning.surroundings import known_raster
from participants.recovery import Recovery
from participants.setup import DriverSetup
from participants.sight import Sight
from protocols.course.occupancy import Occupancy
from protocols.course.route import Route, plan_route
from protocols.wheelchair import LASER_RANGE, MAX_SPEED, MAX_TURN_RATE

PATIENCE = 1.0
"""It tries something else when it cannot move for longer than this, s."""


class AutonomousOptions(Options):
    """What a protocol may set for an autonomous driver.

    Attributes
    ----------
    control_noise
        Standard deviation of the error of either velocity it commands, as a share of the
        velocity; fresh in every step.
    """

    control_noise: Annotated[float, Field(ge=0.0, le=0.2)] = 0.0


class AutonomousDriver:
    """A navigation stack with a map and a laser.

    It plans again in every step from what it sees. It does not know when its commands are scaled
    or replaced. When blocked, it tries small movements, as navigation stacks do.

    Parameters
    ----------
    route
        The global path.
    raster
        Its map.
    rng
        Random numbers of its localisation until a lap brings others.
    window
        Settings of the local planner.
    lookahead
        How far ahead on the path the local planner's target lies, m.
    options
        What else a protocol may set.
    """

    def __init__(
        self,
        route: Route,
        raster: Occupancy,
        rng: np.random.Generator,
        window: DynamicWindow | None = None,
        lookahead: float = 0.9,
        *,
        options: AutonomousOptions | None = None,
    ) -> None:
        self._route = route
        self._raster = raster
        self._window = window if window is not None else DynamicWindow()
        self._lookahead = lookahead
        self._noise = 0.0 if options is None else options.control_noise
        self._localisation = Localisation(rng)
        self._rng = rng
        self._arc: float | None = None
        self._recovery = Recovery(self._raster, PATIENCE)

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:  # noqa: ARG002  # the seam's
        """Forget its place on the path, and localise again."""
        self._localisation = Localisation(rng)
        (self._rng,) = rng.spawn(1)
        self._arc = None
        self._recovery = Recovery(self._raster, PATIENCE)

    def act(self, sight: Sight) -> Command:
        """Choose the best velocities towards a point ahead on the path."""
        return self._inexact(self._choose(sight))

    def _inexact(self, command: Command) -> Command:
        v, w = 1.0 + self._noise * self._rng.normal(size=2)
        return Command(
            min(float(v) * command.v, MAX_SPEED),
            min(max(float(w) * command.w, -MAX_TURN_RATE), MAX_TURN_RATE),
        )

    def _choose(self, sight: Sight) -> Command:
        target = self._target(sight)
        field = scan_field(sight.ranges, sight.bearings, sight.laser, LASER_RANGE)
        choice = choose(field, sight.velocity, target, self._window)
        error = math.atan2(target[1], target[0])
        # It never wants to stand, so it is stuck when no velocity is admissible, too.
        wanted = Command(1.0, 0.0)
        if sight.helped:
            self._recovery.helped()
            return choice.command
        free = self._recovery.movement(sight, wanted, error)
        return choice.command if free is None else free

    def _target(self, sight: Sight) -> tuple[float, float]:
        """Return the point ahead on the path in the chair's frame, m."""
        here = self._localisation.estimate(sight.t, sight.pose)
        arc = self._route.locate(here, sight.gates_passed, self._arc).arc
        self._arc = arc
        aim = self._route.point(arc + self._lookahead)
        dx, dy = aim.x - here.x, aim.y - here.y
        c, s = math.cos(here.heading), math.sin(here.heading)
        return c * dx + s * dy, c * dy - s * dx


def autonomous_driver(setup: DriverSetup) -> AutonomousDriver:
    """Return the autonomous driver for a course; see ``AutonomousOptions``."""
    options = read_options("driver 'autonomous'", AutonomousOptions, setup.options)
    route, raster = plan_route(setup.course), known_raster(setup.course)
    return AutonomousDriver(route, raster, setup.rng, options=options)
