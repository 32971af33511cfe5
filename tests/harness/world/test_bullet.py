"""The physics is honest: rates, straightness, contacts, walls that hold."""

import math
import subprocess
import sys
import xml.etree.ElementTree as ET
from importlib.resources import files

import numpy as np
import pybullet
import pytest

from harness.world import bullet
from harness.world.bullet import LONGEST_STEP, BulletChair
from harness.world.chair import VelocityController
from harness.world.clearance import box_table, clearance
from lad.command import Command
from protocols import wheelchair
from protocols.course.obstacles import Box, obstacle_boxes
from protocols.load import load_course
from protocols.pose import Pose

NOTHING_NEAR = [Box(500.0, 500.0, 0.0, 1.0, 1.0, 1.0, "far")]
ORIGIN = Pose(0.0, 0.0, 0.0)
STEPS = [0.005, 0.01, LONGEST_STEP]


@pytest.fixture(scope="module", params=STEPS)
def chair(request):
    """Return a chair on an empty floor, at each physics step that control periods lead to."""
    chair = BulletChair(NOTHING_NEAR, request.param)
    chair.step_s = request.param
    yield chair
    chair.close()


def _drive(chair, v, w, seconds):
    """Drive from rest for a second, then for a while; return the turn and the way in that while."""
    chair.place(ORIGIN)
    chair.drive(v, w)
    for _ in range(round(1.0 / chair.step_s)):
        chair.advance()
    start = last = chair.pose()
    turned = driven = 0.0
    for _ in range(round(seconds / chair.step_s)):
        chair.advance()
        pose = chair.pose()
        turned += math.remainder(pose.heading - last.heading, math.tau)
        driven += math.dist(pose[:2], last[:2])
        last = pose
    return turned, driven, start, last


@pytest.mark.parametrize("w", [0.5, -0.5, 0.15, -0.15])
@pytest.mark.parametrize("v", [0.0, 0.3, 0.7])
def test_turning_rates_are_what_was_commanded(chair, v, w):
    """0.5 and 0.15 rad/s either way are reached within 2%, in place and at speed."""
    turned, driven, _, _ = _drive(chair, v, w, 4.0)
    assert turned / 4.0 == pytest.approx(w, rel=0.02)
    assert driven / 4.0 == pytest.approx(v, rel=0.02, abs=0.002)


@pytest.mark.parametrize("v", [0.2, 0.7, -0.3])
def test_straight_driving_does_not_drift(chair, v):
    """Over ten seconds the chair leaves its line by less than 2 mm and 0.1 degrees."""
    turned, _, start, end = _drive(chair, v, 0.0, 10.0)
    beside = (end.y - start.y) * math.cos(start.heading) - (end.x - start.x) * math.sin(
        start.heading
    )
    assert abs(turned) < math.radians(0.1)
    assert abs(beside) < 0.002


def test_velocity_is_that_of_the_pose(chair):
    """Measured velocities are the time derivative of the pose, at the axle's midpoint."""
    _drive(chair, 0.6, -0.4, 1.0)
    before = chair.pose()
    for _ in range(10):
        chair.advance()
    after = chair.pose()
    dt = 10 * chair.step_s
    measured = chair.velocity(after.heading)
    assert measured.v == pytest.approx(math.dist(before[:2], after[:2]) / dt, rel=5e-3)
    turned = math.remainder(after.heading - before.heading, math.tau)
    assert measured.w == pytest.approx(turned / dt, rel=5e-3)


def test_the_axle_stays_put_when_turning_in_place(chair):
    """The reference point is the axle's midpoint: turning in place does not move it."""
    _drive(chair, 0.0, 0.5, 6.0)
    x, y, _ = chair.pose()
    assert math.hypot(x, y) < 0.005


def test_the_chair_stands_on_its_four_wheels(chair):
    """It neither tips nor sinks, standing, braking hard or turning fast."""
    chair.place(ORIGIN)
    controller = VelocityController()
    for v, w in ((0.0, 0.0), (0.7, 0.0), (-0.7, 0.5), (0.7, -0.5), (0.0, 0.0)):
        for _ in range(round(2.0 / chair.step_s)):
            controller.approach(Command(v, w), chair.step_s)
            chair.drive(*controller.velocity)
            chair.advance()
            (_, _, z), (qx, qy, _, _) = pybullet.getBasePositionAndOrientation(
                chair._chair, physicsClientId=chair._client
            )
            assert z == pytest.approx(0.35, abs=0.001)
            assert max(abs(qx), abs(qy)) < 0.002
    wheels = {
        c[3]
        for c in pybullet.getContactPoints(chair._chair, physicsClientId=chair._client)
        if c[9] > 0
    }
    assert wheels == {-1, 0, 1}


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("thickness", [0.001, 0.1])
@pytest.mark.parametrize("angle", [0.0, 0.4, 1.2])
def test_walls_hold_at_top_speed(step, thickness, angle):
    """Even a sheet of 1 mm stops the chair: it enters by less than 13 mm and never passes."""
    wall = Box(1.5, 0.0, math.pi / 2 - angle, 8.0, thickness, 1.0, "sheet")
    chair = BulletChair([wall], step)
    chair.place(Pose(-0.5, 0.0, 0.0))
    chair.drive(0.7, 0.0)
    table = box_table([wall])
    touched = False
    for _ in range(round(6.0 / step)):
        chair.advance()
        touched = touched or chair.touching()
        pose = chair.pose()
        assert clearance(table, pose) > -0.013
        x, y = pose.x - 1.5, pose.y
        assert x * math.cos(angle) - y * math.sin(angle) < 0
    assert touched
    chair.close()


@pytest.mark.parametrize("side", [1, -1])
def test_a_contact_is_noticed_when_and_only_when_there_is_one(side):
    """Driving along a wall a centimetre away is no contact; turning into it is one."""
    wall = Box(0.0, side * (wheelchair.WIDTH / 2 + 0.01 + 0.05), 0.0, 20.0, 0.1, 1.0, "wall")
    chair = BulletChair([wall])
    chair.place(Pose(-2.0, 0.0, 0.0))
    chair.drive(0.5, 0.0)
    for _ in range(200):
        chair.advance()
        assert not chair.touching()
    chair.drive(0.0, side * 0.5)
    touches = 0
    for _ in range(80):
        chair.advance()
        touches += chair.touching()
    assert touches > 0
    chair.place(Pose(-2.0, 0.0, 0.0))
    chair.advance()
    assert not chair.touching()
    chair.close()


def test_the_floor_is_no_obstacle(chair):
    """A chair on its wheels touches nothing that counts."""
    _drive(chair, 0.7, 0.5, 1.0)
    assert not chair.touching()


def test_what_is_as_low_as_a_threshold_is_hit_too():
    """A box 0.1 m high stops the chassis although the laser does not see it."""
    chair = BulletChair([Box(1.5, 0.0, 0.0, 0.2, 2.0, 0.1, "threshold")])
    chair.place(ORIGIN)
    chair.drive(0.7, 0.0)
    for _ in range(300):
        chair.advance()
    assert chair.touching()
    assert chair.pose().x < 1.5 - 0.1 - wheelchair.FRONT + 0.01
    chair.close()


def test_all_obstacles_are_one_body_and_none_is_lost():
    """The physics has one body for the course, with a shape per box, beside floor and chair."""
    boxes = obstacle_boxes(load_course("lab-office"))
    chair = BulletChair(boxes)
    client = {"physicsClientId": chair._client}
    assert pybullet.getNumBodies(**client) == 3
    assert len(pybullet.getCollisionShapeData(chair._obstacles, -1, **client)) == len(boxes)
    chair.close()


def test_runs_repeat_to_the_last_bit():
    """The same commands give the same bits: in a second client, and after a lap with crashes."""
    boxes = obstacle_boxes(load_course("lab-office"))
    start = Pose(0.0, 0.0, 0.0)

    def trace(chair):
        chair.place(start)
        rng = np.random.default_rng(3)
        rows = []
        for i in range(600):
            if i % 40 == 0:
                chair.drive(rng.uniform(0.3, 0.7), rng.uniform(-0.5, 0.5))
            chair.advance()
            pose = chair.pose()
            rows.append((*pose, *chair.velocity(pose.heading), chair.touching()))
        return np.array(rows)

    one, two = BulletChair(boxes), BulletChair(boxes)
    first = trace(one)
    assert first[:, 5].any()
    assert np.array_equal(first, trace(one))
    one.place(start)
    one.drive(0.7, 0.3)
    for _ in range(500):
        one.advance()
    assert np.array_equal(first, trace(one))
    assert np.array_equal(first, trace(two))
    one.close()
    two.close()


def test_the_urdf_has_the_chairs_size():
    """What collides is the footprint that all other code uses; wheels are where they belong."""
    urdf = files("harness").joinpath("world", "assets", "wheelchair.urdf")
    root = ET.fromstring(urdf.read_text())  # noqa: S314 - our own file
    chassis = root.find("link[@name='chassis']")
    collision = next(c for c in chassis.findall("collision") if c.find("geometry/box") is not None)
    length, width, _ = map(float, collision.find("geometry/box").get("size").split())
    ahead = float(collision.find("origin").get("xyz").split()[0])
    assert (ahead + length / 2, length / 2 - ahead) == pytest.approx(
        (wheelchair.FRONT, wheelchair.REAR)
    )
    assert width == wheelchair.WIDTH
    for ball in chassis.findall("collision"):
        if ball.find("geometry/sphere") is not None:
            x, y, _ = map(float, ball.find("origin").get("xyz").split())
            radius = float(ball.find("geometry/sphere").get("radius"))
            assert x + radius < wheelchair.FRONT
            assert abs(y) + radius < width / 2
    wheels = [root.find(f"link[@name='{side}_wheel']") for side in ("left", "right")]
    radii = {float(w.find("collision/geometry/sphere").get("radius")) for w in wheels}
    sides = [
        float(root.find(f"joint[@name='{side}_axle']/origin").get("xyz").split()[1])
        for side in ("left", "right")
    ]
    assert radii == {bullet.WHEEL_RADIUS}
    assert sides == pytest.approx([bullet.TRACK / 2, -bullet.TRACK / 2])
    mass = sum(float(m.get("value")) for m in root.iter("mass"))
    assert mass == pytest.approx(100.0)


def test_importing_and_building_print_nothing():
    """PyBullet's own messages stay out of the terminal, and ours come through afterwards."""
    code = (
        "import sys; from harness.world.bullet import BulletChair; BulletChair([]).close();"
        "print('out'); print('err', file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)  # noqa: S603 - our own code
    assert (done.stdout, done.stderr) == ("out\n", "err\n")
