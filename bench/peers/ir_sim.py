"""IR-SIM: kinematic chair, vectorised laser, headless."""

import contextlib
import io
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from peers.shipped_lap import PeerWorld, drive_shipped_lap
from peers.simulator import FIELD_OF_VIEW, RANGE
from ruamel.yaml import YAML

from lad.command import Command
from protocols.course.obstacles import Box, obstacle_boxes
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.wheelchair import FRONT, LASER_AHEAD, MAX_SPEED, MAX_TURN_RATE, REAR, WIDTH

with contextlib.redirect_stdout(io.StringIO()):  # it tells of every window system it misses
    import irsim


class IRSim:
    """One step of the environment per control period: motion, collisions, then the scan."""

    def __init__(self, course: Course, rays: int, rate_hz: int) -> None:
        self._course, self._rays, self._rate_hz = course, rays, rate_hz
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "course.yaml"
            YAML(typ="safe").dump(_world(course, rays, rate_hz), path)
            self._env = irsim.make(str(path), headless=True, log_level="ERROR")

    def restart(self) -> None:
        """Stand still at the start."""
        self._env.reset()

    def sense(self) -> tuple[Pose, NDArray[np.float64]]:
        """Read what the last step left."""
        x, y, heading = self._env.get_robot_state()[:3, 0].tolist()
        return Pose(x, y, heading), self._env.get_lidar_scan()["ranges"]

    def velocity(self) -> Command:
        """Return how the chair moves."""
        v, w = self._env.robot.velocity[:2, 0].tolist()
        return Command(v, w)

    def step(self, command: Command) -> None:
        """Drive for one control period."""
        self._env.step([command.v, command.w])

    def drive_lap(self, time_limit_s: float) -> float:
        """Drive and record a lap in our loop, with our driver, safeguard and record."""
        world = PeerWorld(self, self._course, self._rays, self._rate_hz)
        return drive_shipped_lap(world, self._course, time_limit_s)

    def close(self) -> None:
        """End the environment."""
        self._env.end()


def _world(course: Course, rays: int, rate_hz: int) -> dict[str, Any]:
    side = WIDTH / 2
    start = course.start
    return {
        "world": {
            "width": 14,
            "height": 12,
            "offset": [-1, -1],
            "step_time": 1 / rate_hz,
            "sample_time": 1 / rate_hz,
            "collision_mode": "stop",
        },
        "robot": {
            "kinematics": {"name": "diff"},
            "shape": {
                "name": "polygon",
                "vertices": [[-REAR, -side], [FRONT, -side], [FRONT, side], [-REAR, side]],
            },
            "state": [start.x, start.y, start.heading],
            "vel_max": [MAX_SPEED, MAX_TURN_RATE],
            "vel_min": [-MAX_SPEED, -MAX_TURN_RATE],
            "sensors": [
                {
                    "name": "lidar2d",
                    "range_min": 0,
                    "range_max": RANGE,
                    "angle_range": FIELD_OF_VIEW,
                    "number": rays,
                    "offset": [LASER_AHEAD, 0, 0],
                }
            ],
        },
        "obstacle": [_obstacle(box) for box in obstacle_boxes(course)],
    }


def _obstacle(box: Box) -> dict[str, Any]:
    return {
        "shape": {"name": "rectangle", "length": box.length, "width": box.width},
        "state": [box.cx, box.cy, box.heading],
    }
