"""navground: a kinematic disc among line segments, and its lidar; compiled, single precision."""

import numpy as np
from navground import core, sim
from navground.sim.state_estimations import LidarStateEstimation
from numpy.typing import NDArray
from peers.shipped_lap import PeerWorld, drive_shipped_lap
from peers.simulator import FIELD_OF_VIEW, RANGE

from lad.command import Command
from protocols.course.obstacles import segments
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.wheelchair import LASER_AHEAD, MAX_SPEED, MAX_TURN_RATE, WIDTH


class Navground:
    """A chair that is a disc as wide as ours; collisions push it back."""

    def __init__(self, course: Course, rays: int, rate_hz: int) -> None:
        self._course, self._rays, self._rate_hz = course, rays, rate_hz
        self._world = sim.World()
        for x1, y1, x2, y2 in segments(course):
            self._world.add_wall(sim.Wall(np.array([x1, y1]), np.array([x2, y2])))
        self._lidar = LidarStateEstimation(
            range=RANGE,
            start_angle=-FIELD_OF_VIEW / 2,
            field_of_view=FIELD_OF_VIEW,
            resolution=rays,
            position=np.array([LASER_AHEAD, 0.0]),
        )
        self._chair = sim.Agent(
            radius=WIDTH / 2,
            kinematics=core.kinematics.AheadKinematics(MAX_SPEED, MAX_TURN_RATE),
            state_estimations=[self._lidar],
        )
        self._world.add_agent(self._chair)
        self._world.update(1e-6)
        self._sensed = core.SensingState()
        self._lidar.prepare(self._chair, self._world)
        self._lidar.prepare_state(self._sensed)
        self._last = Command(0.0, 0.0)
        self.restart()

    def restart(self) -> None:
        """Stand still at the start."""
        start = self._course.start
        self._chair.pose = core.Pose2(np.array([start.x, start.y]), start.heading)
        self._last = Command(0.0, 0.0)

    def sense(self) -> tuple[Pose, NDArray[np.float64]]:
        """Scan."""
        self._lidar.update(self._chair, self._world, self._sensed)
        x, y = self._chair.position.tolist()
        pose = Pose(x, y, self._chair.orientation)
        return pose, self._sensed.get_buffer("range").data.astype(np.float64)

    def velocity(self) -> Command:
        """Return how the chair moves: as commanded, at once."""
        return self._last

    def step(self, command: Command) -> None:
        """Drive for one control period."""
        forward = np.array([command.v, 0.0])
        self._chair.last_cmd = core.Twist2(forward, command.w, core.Frame.relative)
        self._world.actuate(1 / self._rate_hz)
        self._last = command

    def drive_lap(self, time_limit_s: float) -> float:
        """Drive and record a lap in our loop, with our driver, safeguard and record."""
        world = PeerWorld(self, self._course, self._rays, self._rate_hz)
        return drive_shipped_lap(world, self._course, time_limit_s)

    def close(self) -> None:
        """Nothing outlives the object."""
