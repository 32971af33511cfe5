"""The wheelchair world in PyBullet."""

import math

import numpy as np
from numpy.typing import NDArray

from harness.world.bullet import LONGEST_STEP, BulletChair
from harness.world.bullet_caster import BulletCaster
from harness.world.chair import VelocityController
from harness.world.clearance import box_table, clearance
from harness.world.laser import SCAN_PERIOD, Laser, MakeCaster
from harness.world.ray_sweep import RaySweep
from harness.world.safeguard import ARM, Safeguard
from harness.world.world import Observation
from lad.command import Command
from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.start_noise import StartNoise
from protocols.study import CasterName, LaserSettings
from protocols.wheelchair import LASER_AHEAD, MAX_SPEED, MAX_TURN_RATE, within_limits

NEAR_TOUCH = 0.02
"""Contacts are computed when the chair could come this near within a control step, m."""


_CASTERS: dict[CasterName, MakeCaster] = {"sweep": RaySweep, "pybullet": BulletCaster}


class BulletWorld:
    """A wheelchair on a course, in PyBullet. Build one per process and reset it for each lap.

    Parameters
    ----------
    course
        The course.
    laser
        How many rays, and who casts them.
    period
        Length of a control step, s.
    scan_period
        Time between laser scans, s; in between, the last one is used.
    start_noise
        How exactly the chair is placed at the start; without error when None.
    """

    def __init__(
        self,
        course: Course,
        laser: LaserSettings | None = None,
        period: float = 0.1,
        scan_period: float = SCAN_PERIOD,
        start_noise: StartNoise | None = None,
    ) -> None:
        settings = LaserSettings() if laser is None else laser
        boxes = obstacle_boxes(course)
        self._start = Pose(course.start.x, course.start.y, course.start.heading)
        self._start_noise = StartNoise() if start_noise is None else start_noise
        self._period = period
        self._substeps = math.ceil(period / LONGEST_STEP - 1e-9)
        self._chair = BulletChair(boxes, period / self._substeps)
        self._controller = VelocityController()
        self._laser = Laser(boxes, settings.rays, _CASTERS[settings.caster])
        self._model_reach = settings.model_reach_m
        self._scan_every = max(1, round(scan_period / period))
        self._table = box_table(boxes)
        self._guard = Safeguard(boxes, period)
        self._step = 0
        self._rng: np.random.Generator | None = None
        self._seen: Observation | None = None

    @property
    def period(self) -> float:
        """Length of a control step, s."""
        return self._period

    @property
    def bearings(self) -> NDArray[np.float64]:
        """Directions of the laser's rays in the chair's frame, from right to left, rad."""
        return self._laser.bearings

    @property
    def laser_offset(self) -> float:
        """The laser's mounting point ahead of the driven axle, m."""
        return LASER_AHEAD

    def reset(self, rng: np.random.Generator) -> None:
        """Place the chair at the start, at rest; ``rng`` is the lap's noise."""
        self._rng = rng
        self._step = 0
        self._seen = None
        self._controller.reset()
        self._chair.place(self._start_pose(rng))
        self._look(contact=False)

    def observe(self) -> Observation:
        """Return the instruments' readings; a second call changes nothing."""
        return self._now()

    def safeguard(self, command: Command) -> Command:
        """Return the command as the safeguard against hard collisions lets it through."""
        return self._guard.guard(command, self._now().pose, self._controller.velocity)

    def step(self, command: Command) -> None:
        """Follow a command for one control step."""
        target = within_limits(command)
        contact = self._move(target, watch=self._within_touch())
        self._step += 1
        self._look(contact)

    def close(self) -> None:
        """Free the physics engine; the world cannot be used afterwards."""
        self._chair.close()

    def _start_pose(self, rng: np.random.Generator) -> Pose:
        noise, start = self._start_noise, self._start
        if noise == StartNoise():  # draw nothing here: it would change the laser's draws
            return start
        x, y, turn = rng.uniform(-1.0, 1.0, size=3)
        return Pose(
            start.x + noise.position_m * x,
            start.y + noise.position_m * y,
            start.heading + noise.heading_rad * turn,
        )

    def _now(self) -> Observation:
        if self._seen is None:
            raise RuntimeError("reset the world before the first step")
        return self._seen

    def _within_touch(self) -> bool:
        """Whether the chair could reach an obstacle within a step at the velocities it may have."""
        return (
            self._now().clearance_m < NEAR_TOUCH + (MAX_SPEED + MAX_TURN_RATE * ARM) * self._period
        )

    def _move(self, target: Command, *, watch: bool) -> bool:
        chair, controller = self._chair, self._controller
        dt = self._period / self._substeps
        touched = False
        for _ in range(self._substeps):
            if controller.approach(target, dt):
                chair.drive(*controller.velocity)
            chair.advance()
            if watch:
                touched = chair.touching() or touched
        if touched:  # the wheels' real speed, or the chair would leap when it comes free
            pose = chair.pose()
            controller.reset(chair.velocity(pose.heading))
        return touched

    def _look(self, contact: bool) -> None:
        pose = self._chair.pose()
        if self._seen is None or self._step % self._scan_every == 0:
            ranges, segments = self._scan(pose)
        else:
            ranges, segments = self._seen.ranges, self._seen.segments
        self._seen = Observation(
            t=self._step * self._period,
            pose=pose,
            velocity=self._chair.velocity(pose.heading),
            ranges=ranges,
            segments=segments,
            # A plain tuple: compiled code takes a named one much more slowly.
            clearance_m=max(0.0, clearance(self._table, (pose.x, pose.y, pose.heading))),
            contact=contact,
        )

    def _scan(self, pose: Pose) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        if self._rng is None:
            raise RuntimeError("reset the world before the first step")
        x = pose.x + LASER_AHEAD * math.cos(pose.heading)
        y = pose.y + LASER_AHEAD * math.sin(pose.heading)
        ranges, segments = self._laser.scan(Pose(x, y, pose.heading), self._rng)
        return ranges, np.minimum(segments, self._model_reach)
