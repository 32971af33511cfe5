"""A small kinematic world to drive laps in: no physics, but walls, a laser and limited forces."""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
import shapely

from lad.command import STILL, Command
from lad.inputs import as_inputs
from participants.sight import Sight
from protocols.course.centreline import Centreline
from protocols.course.gates import GateCounter
from protocols.course.obstacles import floor_plan, segments
from protocols.course.schema import Course
from protocols.load import load_course
from protocols.pose import Pose
from protocols.wheelchair import (
    ACCELERATION,
    FRONT,
    LASER_AHEAD,
    MAX_SPEED,
    MAX_TURN_RATE,
    REAR,
    TURN_ACCELERATION,
    WIDTH,
)

PERIOD = 0.1
SUBSTEPS = 2
RANGE = 4.0
BEARINGS = np.radians(np.linspace(-120.0, 120.0, 121))
OUTLINE = np.array(
    [(FRONT, WIDTH / 2), (-REAR, WIDTH / 2), (-REAR, -WIDTH / 2), (FRONT, -WIDTH / 2)]
)


def limited(command: Command) -> Command:
    """Limit as the study does: full right deflection gives 0.15 rad/s."""
    return Command(command.v, command.w * 0.3 if command.w < 0 else command.w)


@dataclass
class DrivenLap:
    """What happened in a lap, one row per control step."""

    finished: bool = False
    time: float = 0.0
    contacts: int = 0
    rows: list[tuple] = field(default_factory=list)

    def column(self, name: str) -> np.ndarray:
        """Return one stream of the lap by its name."""
        names = ("t", "x", "y", "heading", "v", "w", "user_v", "user_w", "h", "a_v", "a_w", "arc")
        return np.array([row[names.index(name)] for row in self.rows])

    def intervals(self) -> list[tuple[float, float]]:
        """Return stretches of help: first and last time, s."""
        h = np.concatenate([[0], self.column("h") > 0, [0]]).astype(int)
        change = np.flatnonzero(np.diff(h))
        t = self.column("t")
        return [(t[a], t[b - 1]) for a, b in zip(change[::2], change[1::2], strict=True)]


class Room:
    """A course and a chair in it that accelerates as the controller allows and stops at walls."""

    def __init__(self, course: Course, noise: np.random.Generator | None = None) -> None:
        self.course = course
        self.line = Centreline(course)
        self.noise = noise
        self._edges = segments(course)
        self._plan = floor_plan(course)
        shapely.prepare(self._plan)
        self.pose, self.velocity = Pose(0, 0, 0), STILL

    def touches(self, pose: Pose) -> bool:
        """Return whether the chair's outline meets an obstacle."""
        c, s = math.cos(pose.heading), math.sin(pose.heading)
        corners = OUTLINE @ np.array([[c, s], [-s, c]]) + np.array([pose.x, pose.y])
        return bool(shapely.intersects(self._plan, shapely.Polygon(corners)))

    def move(self, command: Command) -> bool:
        """Drive for one period; return whether something was touched."""
        touched = False
        dt = PERIOD / SUBSTEPS
        v_goal = min(max(command.v, -MAX_SPEED), MAX_SPEED)
        w_goal = min(max(command.w, -MAX_TURN_RATE), MAX_TURN_RATE)
        for _ in range(SUBSTEPS):
            v, w = self.velocity
            v += min(max(v_goal - v, -ACCELERATION * dt), ACCELERATION * dt)
            w += min(max(w_goal - w, -TURN_ACCELERATION * dt), TURN_ACCELERATION * dt)
            x, y, heading = self.pose
            middle = heading + w * dt / 2
            new = Pose(
                x + v * dt * math.cos(middle), y + v * dt * math.sin(middle), heading + w * dt
            )
            if self.touches(new):
                self.velocity, touched = STILL, True
            else:
                self.pose, self.velocity = new, Command(v, w)
        return touched

    def scan(self) -> np.ndarray:
        """Return ranges along the rays, exact or with the laser's noise."""
        x, y, heading = self.pose
        ox, oy = x + LASER_AHEAD * math.cos(heading), y + LASER_AHEAD * math.sin(heading)
        dx, dy = np.cos(heading + BEARINGS)[:, None], np.sin(heading + BEARINGS)[:, None]
        ax, ay = self._edges[:, 0] - ox, self._edges[:, 1] - oy
        ex, ey = self._edges[:, 2] - self._edges[:, 0], self._edges[:, 3] - self._edges[:, 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            cross = dx * ey - dy * ex
            far = (ax * ey - ay * ex) / cross
            along = (ax * dy - ay * dx) / cross
        far[~((far > 0) & (along >= 0) & (along <= 1))] = RANGE
        ranges = np.minimum(far.min(axis=1), RANGE)
        if self.noise is not None:
            noisy = ranges + self.noise.normal(0.0, np.maximum(0.01, 0.01 * ranges))
            ranges = np.where(ranges < RANGE, np.clip(noisy, 0.02, RANGE), RANGE)
        return ranges

    def lap(
        self,
        driver,
        helper=None,
        *,
        limitation: Callable = lambda c: c,
        helping=True,
        limit_s=300.0,
        pose=None,
    ) -> DrivenLap:
        """Drive one lap, from the start or a pose; ``helping`` false makes a shadow."""
        start = self.course.start
        self.pose, self.velocity = pose or Pose(start.x, start.y, start.heading), STILL
        gates, lap = GateCounter(self.course), DrivenLap()
        helped, intent, arc, touching, t = False, STILL, None, False, 0.0
        if helper is not None:
            helper.start_lap()
        while t < limit_s and not gates.finished:
            ranges = self.scan()
            sight = Sight(
                t, self.pose, self.velocity, ranges, BEARINGS, LASER_AHEAD, gates.passed, helped
            )
            intent = driver.act(sight) or intent
            user = limitation(intent)
            command, h, a = user, 0, (math.nan, math.nan)
            if helper is not None:
                helper.look(sight)
                answer = helper.assist(as_inputs(user, self.velocity, self._segments(ranges)))
                h, a = int(answer.helping), answer.command or a
                if answer.helping and helping:
                    command = answer.command
            helped = helping and h == 1
            arc, _ = self.line.locate(self.pose.x, self.pose.y, arc)
            lap.rows.append((t, *self.pose, *self.velocity, *user, h, *a, arc))
            before = self.pose
            touched = self.move(command)
            lap.contacts += touched and not touching
            touching = touched
            share = gates.advance(before, self.pose)
            lap.time = t + PERIOD * (share if share is not None else 1.0)
            t = round(t + PERIOD, 6)
        lap.finished = gates.finished
        return lap

    @staticmethod
    def _segments(ranges: np.ndarray) -> np.ndarray:
        edges = np.radians(np.linspace(-90.0, 90.0, 16))
        part = np.digitize(BEARINGS, edges) - 1
        return np.array([ranges[part == i].min() for i in range(15)])


@pytest.fixture(scope="session")
def lab_office() -> Course:
    """Load the shipped default course."""
    return load_course("lab-office")


@pytest.fixture(scope="session")
def room(lab_office) -> Room:
    """Return the default course as a place to drive in, with a perfect laser."""
    return Room(lab_office)


@pytest.fixture(scope="session")
def limitation() -> Callable[[Command], Command]:
    """Return the study's limitation of right turns."""
    return limited


def winding_course() -> Course:
    """Return a corridor with a sharp right, a left, a soft right and another sharp right turn."""
    line = [(0, 0), (4, 0), (4, -4), (8, -4), (11, -5.73), (9.5, -8.33)]
    kinds = ["straight", "sharp_right", "straight", "left", "straight", "soft_right"]
    kinds += ["straight", "sharp_right", "straight"]
    corners = np.cumsum([math.dist(a, b) for a, b in itertools.pairwise(line)])[:-1]
    ends = [end for corner in corners for end in (corner - 0.6, corner + 0.6)]
    walls = shapely.LineString([(-0.8, 0), *line[1:-1], (9.1, -9.02)]).buffer(1.1, join_style=2)
    outline = [(float(x), float(y)) for x, y in walls.exterior.coords[:-1]]
    return Course.model_validate(
        {
            "schema": 1,
            "name": "winding",
            "title": "A winding corridor",
            "walls": [{"name": "wall", "closed": True, "points": outline}],
            "start": {"x": 0, "y": 0, "heading": 0},
            "gates": [
                {"name": "A", "left": (5.1, -2), "right": (2.9, -2)},
                {"name": "F", "left": (10.58, -8.65), "right": (8.67, -7.55)},
            ],
            "centreline": line,
            "sections": [
                {"name": f"{kind} {i}", "kind": kind, "until": end}
                for i, (kind, end) in enumerate(zip(kinds, [*ends, None], strict=True))
            ],
        }
    )


@pytest.fixture(scope="session")
def winding() -> Room:
    """Return a course with turns of every kind."""
    return Room(winding_course())
