"""MuJoCo: driven wheels, ball castors and a static body of boxes at 240 Hz, and mj_multiRay."""

import math

import mujoco
import numpy as np
from numpy.typing import NDArray
from peers.shipped_lap import PeerWorld, drive_shipped_lap
from peers.simulator import (
    CASTOR_AHEAD,
    CASTOR_ASIDE,
    CASTOR_RADIUS,
    PHYSICS_HZ,
    RANGE,
    TRACK,
    WHEEL_RADIUS,
    bearings,
)

from lad.command import Command
from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.wheelchair import FRONT, LASER_AHEAD, LASER_HEIGHT, REAR, WIDTH


class MuJoCo:
    """A chair on a free joint; velocity servos turn its wheels.

    The wheels are spheres: cylinders, which scrub on two points each, turn the chair 7% too
    slowly and take longer.
    """

    def __init__(self, course: Course, rays: int, rate_hz: int) -> None:
        self._course, self._rays, self._rate_hz = course, rays, rate_hz
        self._model = mujoco.MjModel.from_xml_string(_mjcf(course))
        self._data = mujoco.MjData(self._model)
        self._start = course.start
        self._steps = PHYSICS_HZ // rate_hz
        self._chair = self._model.body("chair").id
        ahead = bearings(rays)
        self._cos, self._sin = np.cos(ahead), np.sin(ahead)
        self._directions = np.zeros((rays, 3))
        self._geoms = np.zeros(rays, dtype=np.int32)
        self._distances = np.zeros(rays)
        # Only the boxes: the floor is level with no ray, and the chair sees past itself.
        self._groups = np.array([0, 1, 0, 0, 0, 0], dtype=np.uint8)
        self.restart()

    def restart(self) -> None:
        """Stand still at the start."""
        mujoco.mj_resetData(self._model, self._data)
        start = self._start
        half = start.heading / 2
        self._data.qpos[:7] = (start.x, start.y, 0.0, math.cos(half), 0.0, 0.0, math.sin(half))
        mujoco.mj_forward(self._model, self._data)

    def sense(self) -> tuple[Pose, NDArray[np.float64]]:
        """Cast every ray in one call."""
        pose = self._pose()
        cos, sin = math.cos(pose.heading), math.sin(pose.heading)
        self._directions[:, 0] = cos * self._cos - sin * self._sin
        self._directions[:, 1] = sin * self._cos + cos * self._sin
        laser = np.array([pose.x + LASER_AHEAD * cos, pose.y + LASER_AHEAD * sin, LASER_HEIGHT])
        mujoco.mj_multiRay(
            self._model,
            self._data,
            laser,
            self._directions.reshape(-1),
            self._groups,
            1,
            self._chair,
            self._geoms,
            self._distances,
            None,
            len(self._distances),
            RANGE,
        )
        misses = self._geoms < 0
        return pose, np.minimum(np.where(misses, RANGE, self._distances), RANGE)

    def velocity(self) -> Command:
        """Return how the chair moves; a free joint's velocity is in world axes."""
        heading = self._pose().heading
        vx, vy = self._data.qvel[0], self._data.qvel[1]
        return Command(float(vx * math.cos(heading) + vy * math.sin(heading)), self._data.qvel[5])

    def step(self, command: Command) -> None:
        """Turn the wheels for one control period."""
        turn = command.w * TRACK / 2
        self._data.ctrl[0] = (command.v - turn) / WHEEL_RADIUS
        self._data.ctrl[1] = (command.v + turn) / WHEEL_RADIUS
        mujoco.mj_step(self._model, self._data, self._steps)

    def drive_lap(self, time_limit_s: float) -> float:
        """Drive and record a lap in our loop, with our driver, safeguard and record."""
        world = PeerWorld(self, self._course, self._rays, self._rate_hz)
        return drive_shipped_lap(world, self._course, time_limit_s)

    def close(self) -> None:
        """Nothing outlives the object."""

    def _pose(self) -> Pose:
        x, y, _, qw, qx, qy, qz = self._data.qpos[:7].tolist()
        heading = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
        return Pose(x, y, heading)


def _mjcf(course: Course) -> str:
    boxes = "".join(
        f'<geom type="box" group="1" pos="{b.cx} {b.cy} {b.height / 2}" euler="0 0 {b.heading}"'
        f' size="{b.length / 2} {b.width / 2} {b.height / 2}"/>\n'
        for b in obstacle_boxes(course)
    )
    wheels = "".join(
        f'<body name="{name}" pos="0 {y} {WHEEL_RADIUS}"><joint name="{name}" axis="0 1 0"/>'
        f'<geom type="sphere" size="{WHEEL_RADIUS}" mass="3"/>'
        "</body>\n"
        for name, y in (("left", TRACK / 2), ("right", -TRACK / 2))
    )
    castors = "".join(
        f'<geom type="sphere" pos="{CASTOR_AHEAD} {y} {CASTOR_RADIUS}" size="{CASTOR_RADIUS}"'
        ' mass="1" condim="1" priority="1"/>\n'
        for y in (CASTOR_ASIDE, -CASTOR_ASIDE)
    )
    return f"""
    <mujoco>
      <compiler angle="radian"/>
      <option timestep="{1 / PHYSICS_HZ}" integrator="implicitfast"/>
      <worldbody>
        <geom type="plane" size="20 20 1"/>
        {boxes}
        <body name="chair">
          <freejoint/>
          <geom type="box" pos="{(FRONT - REAR) / 2} 0 0.2" mass="50"
                size="{(FRONT + REAR) / 2} {WIDTH / 2} 0.075"/>
          {castors}
          {wheels}
        </body>
      </worldbody>
      <actuator>
        <velocity joint="left" kv="100"/>
        <velocity joint="right" kv="100"/>
      </actuator>
    </mujoco>
    """
