"""The physics engine: a chair that drives and collides, and rays. Nothing else imports PyBullet.

Every call names its client. The choices here were measured: see the notes beside them.
"""

import contextlib
import math
import os
import sys
import tempfile
import weakref
from collections.abc import Iterator, Sequence
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from protocols.course.obstacles import Box
from protocols.pose import Pose


@contextlib.contextmanager
def _hushed() -> Iterator[None]:
    """Discard what the C library prints."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept, nowhere = (os.dup(1), os.dup(2)), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        for number, copy in zip((1, 2), kept, strict=True):
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)


with _hushed():  # it prints its build time whenever it is imported
    import pybullet

LONGEST_STEP = 1 / 60
"""Longest physics step, s: at top speed the chair enters a wall by 12 mm before it is stopped."""

SOFTNESS = 1e-6
"""Constraint force mixing; without it the direct solver meets singular friction rows."""

WHEEL_RADIUS = 0.16
TRACK = 0.46
"""As in the URDF, m."""

MOTOR_TORQUE = 60.0
"""Of one wheel, N m; below 40 the chair does not reach its rates at speed."""

FLOOR, CHASSIS, OBSTACLES = 1, 2, 4
"""Collision groups: wheels meet the floor, the chassis meets both, floor and obstacles nothing."""


def _connect() -> int:
    client = int(pybullet.connect(pybullet.DIRECT))
    if client < 0:  # pragma: no cover - PyBullet allows more than a thousand clients
        raise RuntimeError("PyBullet has no free client left")
    return client


class BulletChair:
    """A wheelchair among obstacles, in a client of its own.

    Parameters
    ----------
    boxes
        The obstacles.
    step
        Length of a physics step, s.
    """

    def __init__(self, boxes: Sequence[Box], step: float = LONGEST_STEP) -> None:
        self._client = _connect()
        self._close = weakref.finalize(self, pybullet.disconnect, self._client)
        with _hushed():
            pybullet.setPhysicsEngineParameter(
                fixedTimeStep=step,
                # The direct solver reaches every rate within 0.01% at any step up to 50 ms. The
                # iterative one costs as much for a drift of 0.6 mrad/s at 10 iterations.
                constraintSolverType=pybullet.CONSTRAINT_SOLVER_LCP_DANTZIG,
                globalCFM=SOFTNESS,
                # The default lets static bodies collide once groups are set: 2 ms per step.
                collisionFilterMode=0,
                enableFileCaching=0,
                physicsClientId=self._client,
            )
        pybullet.setGravity(0, 0, -9.81, physicsClientId=self._client)
        self._add_floor()
        self._obstacles = self._add_obstacles(boxes)
        self._chair, self._wheels = self._add_chair()
        info = pybullet.getDynamicsInfo(self._chair, -1, physicsClientId=self._client)
        self._centre: tuple[float, float, float] = info[3]

    def close(self) -> None:
        """Disconnect; the chair is gone afterwards."""
        self._close()

    def place(self, pose: Pose) -> None:
        """Place the chair at a pose, at rest."""
        x, y, heading = pose
        cx, cy, cz = self._centre
        cos, sin = math.cos(heading), math.sin(heading)
        pybullet.resetBasePositionAndOrientation(
            self._chair,
            (x + cos * cx - sin * cy, y + sin * cx + cos * cy, cz),
            (0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2)),
            physicsClientId=self._client,
        )
        pybullet.resetBaseVelocity(self._chair, (0, 0, 0), (0, 0, 0), physicsClientId=self._client)
        for wheel in self._wheels:
            pybullet.resetJointState(self._chair, wheel, 0.0, 0.0, physicsClientId=self._client)
        self.drive(0.0, 0.0)

    def drive(self, v: float, w: float) -> None:
        """Set the wheels' speeds for a velocity of the chair, m/s and rad/s."""
        pybullet.setJointMotorControlArray(
            self._chair,
            self._wheels,
            pybullet.VELOCITY_CONTROL,
            targetVelocities=[(v + side * w * TRACK / 2) / WHEEL_RADIUS for side in (-1.0, 1.0)],
            forces=(MOTOR_TORQUE, MOTOR_TORQUE),
            # The default of 0.1 takes tens of steps to reach a speed.
            velocityGains=(1.0, 1.0),
            physicsClientId=self._client,
        )

    def advance(self) -> None:
        """Make one physics step."""
        pybullet.stepSimulation(self._client)

    def pose(self) -> Pose:
        """Return where the midpoint of the driven axle is."""
        (x, y, _), (_, _, qz, qw) = pybullet.getBasePositionAndOrientation(
            self._chair, physicsClientId=self._client
        )
        heading = 2 * math.atan2(qz, qw)
        heading = math.remainder(heading, math.tau)
        cos, sin = math.cos(heading), math.sin(heading)
        cx, cy, _ = self._centre
        return Pose(x - cos * cx + sin * cy, y - sin * cx - cos * cy, heading)

    def velocity(self, heading: float) -> Command:
        """Return the velocity along a heading and around the vertical, as odometry measures it."""
        (vx, vy, _), (_, _, w) = pybullet.getBaseVelocity(self._chair, physicsClientId=self._client)
        return Command(vx * math.cos(heading) + vy * math.sin(heading), w)

    def touching(self) -> bool:
        """Whether an obstacle pressed against the chassis in the last step."""
        contacts = pybullet.getContactPoints(
            self._chair, self._obstacles, physicsClientId=self._client
        )
        return any(contact[9] > 0.0 for contact in contacts)

    def _add_floor(self) -> None:
        shape = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=self._client)
        floor = pybullet.createMultiBody(0.0, shape, physicsClientId=self._client)
        pybullet.changeDynamics(floor, -1, lateralFriction=1.0, physicsClientId=self._client)
        self._group(floor, -1, FLOOR, FLOOR | CHASSIS)

    def _add_obstacles(self, boxes: Sequence[Box]) -> int:
        """Load all boxes as one static body: each body of its own costs 0.2 us in every step.

        Through a URDF, because createCollisionShapeArray silently keeps only 16 shapes.
        """
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "course.urdf"
            path.write_text(_compound_urdf(boxes), encoding="utf-8")
            body = int(
                pybullet.loadURDF(str(path), useFixedBase=True, physicsClientId=self._client)
            )
        self._group(body, -1, OBSTACLES, CHASSIS)
        return body

    def _add_chair(self) -> tuple[int, tuple[int, int]]:
        with as_file(files("harness").joinpath("world", "assets", "wheelchair.urdf")) as path:
            flags = pybullet.URDF_USE_INERTIA_FROM_FILE
            body = int(pybullet.loadURDF(str(path), flags=flags, physicsClientId=self._client))
        left, right = 0, 1
        for link in (-1, left, right):
            pybullet.changeDynamics(
                body,
                link,
                # The castor balls are one rigid body with the chassis, which therefore slides too.
                lateralFriction=0.0 if link == -1 else 1.0,
                linearDamping=0.0,
                angularDamping=0.0,
                jointDamping=0.0,
                physicsClientId=self._client,
            )
        self._group(body, -1, CHASSIS, FLOOR | OBSTACLES)
        for wheel in (left, right):
            self._group(body, wheel, CHASSIS, FLOOR)
        return body, (left, right)

    def _group(self, body: int, link: int, group: int, mask: int) -> None:
        pybullet.setCollisionFilterGroupMask(body, link, group, mask, physicsClientId=self._client)


def _compound_urdf(boxes: Sequence[Box]) -> str:
    """Write the boxes as one link, a line each: PyBullet does not parse long lines."""
    shapes = "\n".join(
        f'<collision><origin xyz="{b.cx!r} {b.cy!r} {b.height / 2!r}" rpy="0 0 {b.heading!r}"/>'
        f'<geometry><box size="{b.length!r} {b.width!r} {b.height!r}"/></geometry></collision>'
        for b in boxes
    )
    return (
        '<?xml version="1.0"?>\n<robot name="course">\n<link name="obstacles">\n'
        '<inertial><mass value="0"/>'
        '<inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial>\n'
        f"{shapes}\n</link>\n</robot>\n"
    )


class BulletRays:
    """PyBullet's rays against the obstacles as one triangle mesh, in a client of its own.

    In the chair's client a third of the rays would hit the chair; boxes instead of the mesh cost
    twice the time and miss more grazing edges.
    """

    def __init__(self, boxes: Sequence[Box]) -> None:
        self._client = _connect()
        self._close = weakref.finalize(self, pybullet.disconnect, self._client)
        if not boxes:
            return
        vertices, indices = _mesh(boxes)
        shape = pybullet.createCollisionShape(
            pybullet.GEOM_MESH,
            vertices=vertices,
            indices=indices,
            flags=pybullet.GEOM_FORCE_CONCAVE_TRIMESH,
            physicsClientId=self._client,
        )
        pybullet.createMultiBody(0.0, shape, physicsClientId=self._client)

    def close(self) -> None:
        """Disconnect."""
        self._close()

    def cast(self, starts: NDArray[np.float64], ends: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far each ray gets, as a fraction of its length.

        Parameters
        ----------
        starts, ends
            Shape (n, 3), metres; n at most 16,383.

        Returns
        -------
        NDArray
            Shape (n,), in [0, 1]; 1 where nothing is hit.
        """
        hits: Any = pybullet.rayTestBatch(starts, ends, physicsClientId=self._client)
        return np.fromiter((hit[2] for hit in hits), dtype=np.float64, count=len(starts))


def _mesh(boxes: Sequence[Box]) -> tuple[list[list[float]], list[int]]:
    vertices: list[list[float]] = []
    indices: list[int] = []
    # Corners 0 to 3 stand on the floor, anticlockwise; 4 to 7 are above them.
    quads = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7), (0, 3, 2, 1))
    for box in boxes:
        first = len(vertices)
        vertices += [[x, y, z] for z in (0.0, box.height) for x, y in box.corners().tolist()]
        for a, b, c, d in quads:
            indices += [first + i for i in (a, b, c, a, c, d)]
    return vertices, indices
