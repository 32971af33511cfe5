"""The last guard: no hard collision, and no interference without need."""

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from harness.world.chair import approached
from harness.world.clearance import box_table, clearance
from harness.world.safeguard import FLOOR, MARGIN, Safeguard
from lad.command import STILL, Command
from protocols.course.drivable import footprint
from protocols.course.obstacles import Box, floor_plan, obstacle_boxes
from protocols.load import load_course
from protocols.pose import Pose
from protocols.wheelchair import FRONT, MAX_SPEED, MAX_TURN_RATE, REAR, WIDTH

PERIOD = 0.1
BOXES = obstacle_boxes(load_course("lab-office"))
TABLE = box_table(BOXES)
PLAN = floor_plan(load_course("lab-office"))
GUARD = Safeguard(BOXES, PERIOD)

speeds = st.floats(-MAX_SPEED, MAX_SPEED)
turns = st.floats(-MAX_TURN_RATE, MAX_TURN_RATE)


class Toy:
    """A chair without physics: it moves as its controller wants, under a guard."""

    def __init__(self, guard, table, pose, period=PERIOD):
        self.guard, self.table, self.pose, self.period = guard, table, pose, period
        self.velocity = STILL
        self.nearest = clearance(table, pose)

    def step(self, command):
        """Follow a guarded command for one step; return what the guard let through."""
        allowed = self.guard.guard(command, self.pose, self.velocity)
        for _ in range(20):
            dt = self.period / 20
            self.velocity = approached(self.velocity, allowed, dt)
            v, w = self.velocity
            x, y, heading = self.pose
            middle = heading + w * dt / 2
            self.pose = Pose(
                x + v * dt * math.cos(middle), y + v * dt * math.sin(middle), heading + w * dt
            )
            self.nearest = min(self.nearest, clearance(self.table, self.pose))
        return allowed


def _free_pose(rng, distance=0.05):
    while True:
        x, y, heading = rng.uniform((-5, -7, -math.pi), (5, 2, math.pi))
        if footprint(x, y, heading).distance(PLAN) > distance:
            return Pose(float(x), float(y), float(heading))


def _wall_ahead(distance, tilt=0.0):
    """Return a long wall, its face a distance ahead of the chair's front at the origin."""
    half = 0.05
    x = FRONT + distance + half * math.cos(tilt)
    return [Box(x, half * math.sin(tilt), math.pi / 2 + tilt, 40.0, 2 * half, 1.0, "wall")]


def test_full_speed_from_anywhere_never_touches():
    """Constant commands of all kinds, from 150 places on the course: the guard keeps it off."""
    rng = np.random.default_rng(0)
    for _ in range(150):
        toy = Toy(GUARD, TABLE, _free_pose(rng))
        command = Command(rng.choice([0.7, 0.7, -0.7, 0.0]), rng.choice([0.0, 0.5, -0.5, 0.2]))
        for _ in range(50):
            toy.step(command)
        assert toy.nearest > 0.5 * FLOOR


def test_changing_commands_never_touch_either():
    """A driver who slams the stick about for a minute does not touch anything."""
    rng = np.random.default_rng(1)
    for _ in range(6):
        toy = Toy(GUARD, TABLE, _free_pose(rng))
        for k in range(600):
            if k % 4 == 0:
                command = Command(rng.uniform(-0.7, 0.7), rng.uniform(-0.5, 0.5))
            toy.step(command)
        assert toy.nearest > 0.5 * FLOOR


@pytest.mark.parametrize("period", [0.05, 0.1, 0.3])
@pytest.mark.parametrize("tilt", [0.0, 0.5, -0.9])
def test_a_wall_ahead_is_approached_and_not_hit(period, tilt):
    """Driven at a wall the chair comes near it, to a few centimetres, and stands."""
    boxes = _wall_ahead(2.0, tilt)
    table = box_table(boxes)
    toy = Toy(Safeguard(boxes, period), table, Pose(0.0, 0.0, 0.0), period)
    for _ in range(round(10 / period)):
        toy.step(Command(0.7, 0.0))
    assert MARGIN / 2 < toy.nearest < 0.12
    assert toy.velocity.v < 0.02


@settings(deadline=None)
@given(speeds, turns, speeds, turns)
def test_far_from_everything_nothing_is_changed(v, w, v_now, w_now):
    """In the open every command passes as it is, and is the very same object."""
    command = Command(v, w)
    guard = Safeguard(_wall_ahead(4.0), PERIOD)
    assert guard.guard(command, Pose(0.0, 0.0, 0.0), Command(v_now, w_now)) is command


@settings(deadline=None)
@given(st.integers(0, 10_000), speeds, turns, st.floats(0, 1))
def test_the_guard_only_takes_away(seed, v, w, moving):
    """Neither velocity grows or changes its sign: the guard does not steer."""
    pose = _free_pose(np.random.default_rng(seed), distance=0.01)
    allowed = GUARD.guard(Command(v, w), pose, Command(moving * v, moving * w))
    assert 0 <= allowed.v * v <= v * v + 1e-15
    assert 0 <= allowed.w * w <= w * w + 1e-15


@pytest.mark.parametrize("gap", [0.04, 0.1])
@pytest.mark.parametrize("side", [1, -1])
def test_driving_along_a_wall_is_let_alone(gap, side):
    """Parallel to a wall, 4 cm away, full speed is let through."""
    wall = [Box(0.0, side * (WIDTH / 2 + gap + 0.05), 0.0, 40.0, 0.1, 1.0, "wall")]
    command = Command(0.7, 0.0)
    guard = Safeguard(wall, PERIOD)
    assert guard.guard(command, Pose(0.0, 0.0, 0.0), command) is command


@pytest.mark.parametrize("w", [0.5, -0.5, 0.15])
def test_turning_in_place_beside_a_wall_is_let_alone(w):
    """Where the footprint's corners have room to swing, the chair turns all the way round."""
    reach = math.hypot(FRONT, WIDTH / 2)
    wall = [Box(0.0, reach + MARGIN + 0.06, 0.0, 40.0, 0.1, 1.0, "wall")]
    toy = Toy(Safeguard(wall, PERIOD), box_table(wall), Pose(0.0, 0.0, 0.0))
    command = Command(0.0, w)
    for _ in range(140):
        assert toy.step(command) is command


@pytest.mark.parametrize("gap", [0.0, 0.001, 0.01, MARGIN, 0.05])
def test_one_can_always_drive_away_from_a_wall(gap):
    """With its nose at a wall, touching or not, the chair backs off at full speed at once."""
    boxes = _wall_ahead(gap)
    toy = Toy(Safeguard(boxes, PERIOD), box_table(boxes), Pose(0.0, 0.0, 0.0))
    back = Command(-0.7, 0.0)
    for _ in range(20):
        assert toy.step(back) is back
    assert toy.pose.x < -0.5


@pytest.mark.parametrize("gap", [0.008, 0.02, 0.05])
@pytest.mark.parametrize("side", [1, -1])
def test_one_can_steer_off_a_wall_alongside(gap, side):
    """Beside a wall, full ahead and full lock away from it comes free without a deadlock."""
    wall = [Box(0.0, side * (WIDTH / 2 + gap + 0.05), 0.0, 60.0, 0.1, 1.0, "wall")]
    toy = Toy(Safeguard(wall, PERIOD), box_table(wall), Pose(-5.0, 0.0, 0.0))
    for _ in range(60):
        toy.step(Command(0.7, -side * 0.5))
    assert toy.pose.y * side < -0.4
    assert toy.nearest > 0.5 * FLOOR


def test_a_dead_end_can_be_left_in_reverse():
    """In a niche 4 cm wider than the chair on either side, it goes in, stops, and comes out."""
    half = WIDTH / 2 + 0.04 + 0.05
    boxes = [
        Box(0.0, half, 0.0, 4.0, 0.1, 1.0, "left"),
        Box(0.0, -half, 0.0, 4.0, 0.1, 1.0, "right"),
        Box(2.0, 0.0, math.pi / 2, 1.0, 0.1, 1.0, "end"),
    ]
    toy = Toy(Safeguard(boxes, PERIOD), box_table(boxes), Pose(-3.0, 0.0, 0.0))
    for _ in range(100):
        toy.step(Command(0.7, 0.0))
    assert toy.pose.x + FRONT == pytest.approx(1.95 - MARGIN, abs=0.08)
    for _ in range(100):
        toy.step(Command(-0.7, 0.0))
    assert toy.pose.x < -3.0 + REAR
    assert toy.nearest > 0.5 * FLOOR


def test_reversing_is_guarded_too():
    """A wall behind is kept off as well as one ahead: the scanners see all around."""
    wall = [Box(-1.5, 0.0, math.pi / 2, 10.0, 0.1, 1.0, "behind")]
    toy = Toy(Safeguard(wall, PERIOD), box_table(wall), Pose(0.0, 0.0, 0.0))
    for _ in range(60):
        toy.step(Command(-0.7, 0.0))
    assert toy.nearest > 0.5 * FLOOR
    assert toy.pose.x < -0.9


def test_too_late_means_the_brakes():
    """When not even braking keeps the distance, the guard brakes."""
    guard = Safeguard(_wall_ahead(0.1), PERIOD)
    fast = Command(0.7, 0.0)
    assert guard.guard(fast, Pose(0.0, 0.0, 0.0), fast) == STILL


def test_a_lap_down_the_middle_is_not_disturbed():
    """Following the default course's centreline with room to all sides, the guard keeps still."""
    course = load_course("lab-office")
    points = shapely.LineString(course.centreline).segmentize(0.1)
    rows = shapely.get_coordinates(points)
    changed = 0
    for (ax, ay), (bx, by) in itertools.pairwise(rows):
        pose = Pose(float(ax), float(ay), math.atan2(by - ay, bx - ax))
        command = Command(0.3, 0.0)
        changed += GUARD.guard(command, pose, command) is not command
    assert changed == 0
