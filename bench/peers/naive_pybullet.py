"""PyBullet as its examples use it: a body for every box, swivel castors, Python lists."""

import math
import tempfile
from pathlib import Path

import numpy as np
import pybullet
import pybullet_data
from numpy.typing import NDArray
from peers.numpy_lap import drive_numpy_lap
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

MOTOR_TORQUE = 100.0
"""Of one wheel, N m: enough to hold any speed the chair is sent."""


class NaivePyBullet:
    """Cylinder wheels and swivel castors at 240 Hz and PyBullet's default solver settings."""

    def __init__(self, course: Course, rays: int, rate_hz: int) -> None:
        self._course, self._rays, self._rate_hz = course, rays, rate_hz
        self._client = pybullet.connect(pybullet.DIRECT)
        self._start = course.start
        self._steps = PHYSICS_HZ // rate_hz
        self._bearings = bearings(rays).tolist()
        pybullet.setAdditionalSearchPath(pybullet_data.getDataPath(), physicsClientId=self._client)
        pybullet.setGravity(0, 0, -9.81, physicsClientId=self._client)
        pybullet.loadURDF("plane.urdf", physicsClientId=self._client)
        for box in obstacle_boxes(course):
            shape = pybullet.createCollisionShape(
                pybullet.GEOM_BOX,
                halfExtents=[box.length / 2, box.width / 2, box.height / 2],
                physicsClientId=self._client,
            )
            pybullet.createMultiBody(
                baseMass=0,
                baseCollisionShapeIndex=shape,
                basePosition=[box.cx, box.cy, box.height / 2],
                baseOrientation=pybullet.getQuaternionFromEuler([0, 0, box.heading]),
                physicsClientId=self._client,
            )
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "wheelchair.urdf"
            path.write_text(_urdf(), encoding="utf-8")
            self._chair = pybullet.loadURDF(str(path), physicsClientId=self._client)
        self._joints = {
            pybullet.getJointInfo(self._chair, i, physicsClientId=self._client)[1].decode(): i
            for i in range(pybullet.getNumJoints(self._chair, physicsClientId=self._client))
        }
        for name, joint in self._joints.items():
            if "castor" in name:  # PyBullet brakes every joint until it is told not to
                pybullet.setJointMotorControl2(
                    self._chair,
                    joint,
                    pybullet.VELOCITY_CONTROL,
                    force=0,
                    physicsClientId=self._client,
                )
        self.restart()

    def restart(self) -> None:
        """Stand still at the start."""
        pybullet.resetBasePositionAndOrientation(
            self._chair,
            [self._start.x, self._start.y, 0.0],
            pybullet.getQuaternionFromEuler([0, 0, self._start.heading]),
            physicsClientId=self._client,
        )
        pybullet.resetBaseVelocity(self._chair, [0, 0, 0], [0, 0, 0], physicsClientId=self._client)
        for joint in self._joints.values():
            pybullet.resetJointState(self._chair, joint, 0, 0, physicsClientId=self._client)

    def sense(self) -> tuple[Pose, NDArray[np.float64]]:
        """Cast every ray from a list of points to a list of points."""
        (x, y, _), orientation = pybullet.getBasePositionAndOrientation(
            self._chair, physicsClientId=self._client
        )
        heading = pybullet.getEulerFromQuaternion(orientation)[2]
        laser_x = x + LASER_AHEAD * math.cos(heading)
        laser_y = y + LASER_AHEAD * math.sin(heading)
        starts = [[laser_x, laser_y, LASER_HEIGHT]] * len(self._bearings)
        ends = [
            [
                laser_x + RANGE * math.cos(heading + bearing),
                laser_y + RANGE * math.sin(heading + bearing),
                LASER_HEIGHT,
            ]
            for bearing in self._bearings
        ]
        hits = pybullet.rayTestBatch(starts, ends, physicsClientId=self._client)
        return Pose(x, y, heading), np.array([hit[2] * RANGE for hit in hits])

    def velocity(self) -> Command:
        """Return how the chair moves."""
        (vx, vy, _), (_, _, w) = pybullet.getBaseVelocity(self._chair, physicsClientId=self._client)
        _, orientation = pybullet.getBasePositionAndOrientation(
            self._chair, physicsClientId=self._client
        )
        heading = pybullet.getEulerFromQuaternion(orientation)[2]
        return Command(vx * math.cos(heading) + vy * math.sin(heading), w)

    def step(self, command: Command) -> None:
        """Turn the wheels for one control period."""
        for name, side in (("left", -1), ("right", 1)):
            pybullet.setJointMotorControl2(
                self._chair,
                self._joints[f"{name} wheel"],
                pybullet.VELOCITY_CONTROL,
                targetVelocity=(command.v + side * command.w * TRACK / 2) / WHEEL_RADIUS,
                force=MOTOR_TORQUE,
                physicsClientId=self._client,
            )
        for _ in range(self._steps):
            pybullet.stepSimulation(physicsClientId=self._client)

    def drive_lap(self, time_limit_s: float) -> float:
        """Drive and record a lap with numpy rollouts."""
        return drive_numpy_lap(self, self._course, self._rays, self._rate_hz, time_limit_s)

    def close(self) -> None:
        """Disconnect."""
        pybullet.disconnect(self._client)


def _urdf() -> str:
    """Return the chair: its frame is the middle of the axle on the floor."""
    wheels = "".join(
        _link(f"{name} wheel", 3.0, 0.02, _cylinder(WHEEL_RADIUS))
        + _joint(f"{name} wheel", "chair", (0.0, y, WHEEL_RADIUS), "0 1 0")
        for name, y in (("left", TRACK / 2), ("right", -TRACK / 2))
    )
    castors = "".join(
        _link(f"{name} castor fork", 0.5, 0.002)
        + _joint(f"{name} castor fork", "chair", (CASTOR_AHEAD, y, 2 * CASTOR_RADIUS), "0 0 1")
        + _link(f"{name} castor", 0.5, 0.002, _cylinder(CASTOR_RADIUS))
        + _joint(f"{name} castor", f"{name} castor fork", (-0.05, 0.0, -CASTOR_RADIUS), "0 1 0")
        for name, y in (("left", CASTOR_ASIDE), ("right", -CASTOR_ASIDE))
    )
    chassis = (
        f'<collision><origin xyz="{(FRONT - REAR) / 2} 0 0.2"/>'
        f'<geometry><box size="{FRONT + REAR} {WIDTH} 0.15"/></geometry></collision>'
    )
    body = _link("chair", 50.0, 3.0, chassis, (0.15, 0.0, 0.25))
    return f'<robot name="wheelchair">\n{body}{wheels}{castors}</robot>\n'


def _cylinder(radius: float) -> str:
    shape = f'<cylinder radius="{radius}" length="0.04"/>'
    turned = f'<origin rpy="{math.pi / 2} 0 0"/>'
    return f"<collision>{turned}<geometry>{shape}</geometry></collision>"


def _link(
    name: str,
    mass: float,
    inertia: float,
    collision: str = "",
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> str:
    return (
        f'<link name="{name}">\n<inertial><origin xyz="{_xyz(centre)}"/><mass value="{mass}"/>\n'
        f'<inertia ixx="{inertia}" iyy="{inertia}" izz="{inertia}" ixy="0" ixz="0" iyz="0"/>'
        f"</inertial>\n{collision}\n</link>\n"
    )


def _joint(name: str, parent: str, at: tuple[float, float, float], axis: str) -> str:
    return (
        f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{name}"/>\n'
        f'<origin xyz="{_xyz(at)}"/><axis xyz="{axis}"/></joint>\n'
    )


def _xyz(at: tuple[float, float, float]) -> str:
    return " ".join(str(value) for value in at)
