"""The world as a lap meets it."""

import itertools
import math

import numpy as np
import pytest
import shapely

from harness.world.bullet_world import BulletWorld
from lad.command import STILL, Command
from lad.inputs import N_SEGMENTS
from protocols.course.drivable import footprint
from protocols.course.obstacles import floor_plan
from protocols.load import load_course
from protocols.start_noise import StartNoise
from protocols.study import LaserSettings
from protocols.wheelchair import ACCELERATION, LASER_AHEAD, LASER_RANGE, TURN_ACCELERATION

COURSE = load_course("lab-office")
PLAN = floor_plan(COURSE)


@pytest.fixture(scope="module")
def world():
    """Return one world for all laps, as a process has it."""
    world = BulletWorld(COURSE)
    yield world
    world.close()


def _rows(world, seed, steps=150, commands=7):
    """Drive wildly; return all that was observed."""
    rng = np.random.default_rng(commands)
    world.reset(np.random.default_rng(seed))
    rows = []
    for k in range(steps):
        if k % 12 == 0:
            command = Command(rng.uniform(-0.3, 0.7), rng.uniform(-0.5, 0.5))
        world.step(command)
        seen = world.observe()
        rows.append(
            (seen.t, *seen.pose, *seen.velocity, *seen.ranges, *seen.segments, seen.clearance_m,
             seen.contact)
        )  # fmt: skip
    return np.array(rows)


def test_a_lap_starts_at_the_start_at_rest(world):
    """After a reset the chair stands at the start pose at time 0, untouched."""
    world.reset(np.random.default_rng(0))
    seen = world.observe()
    start = COURSE.start
    assert seen.t == 0.0
    assert seen.pose == pytest.approx((start.x, start.y, start.heading), abs=1e-9)
    assert seen.velocity == STILL
    assert not seen.contact


def test_start_noise_moves_the_start_within_its_bounds():
    """Each lap begins elsewhere, never farther off than the protocol says, by its own draws."""
    noise = StartNoise(position_m=0.1, heading_rad=0.05)
    world = BulletWorld(COURSE, start_noise=noise)
    start = np.array([COURSE.start.x, COURSE.start.y, COURSE.start.heading])
    poses = []
    for seed in (*range(40), 0):
        world.reset(np.random.default_rng(seed))
        poses.append(np.array(world.observe().pose) - start)
    world.close()
    off = np.abs(poses)
    assert (off <= np.array([0.1, 0.1, 0.05]) + 1e-9).all()
    assert (off.max(axis=0) > np.array([0.08, 0.08, 0.04])).all()
    np.testing.assert_array_equal(poses[0], poses[-1])


def test_observing_changes_nothing(world):
    """Asked twice, the instruments say the same: no noise is drawn for looking."""
    world.reset(np.random.default_rng(0))
    assert world.observe() is world.observe()


def test_an_observation_has_the_contracts_shapes(world):
    """Rays, segments and bearings fit one another and lie in their ranges."""
    world.reset(np.random.default_rng(0))
    seen = world.observe()
    assert seen.ranges.shape == world.bearings.shape == (180,)
    assert seen.segments.shape == (N_SEGMENTS,)
    assert (seen.ranges > 0).all()
    assert (seen.ranges <= LASER_RANGE).all()
    assert world.laser_offset == LASER_AHEAD
    assert world.period == 0.1


@pytest.mark.parametrize("period", [0.05, 0.1, 0.3])
def test_time_and_acceleration_go_by_the_control_period(period):
    """At any control period time adds up, and velocities rise as the controller lets them."""
    world = BulletWorld(COURSE, period=period)
    world.reset(np.random.default_rng(0))
    for k in range(1, 4):
        world.step(Command(0.7, 0.0))
        seen = world.observe()
        assert seen.t == pytest.approx(k * period)
        assert seen.velocity.v == pytest.approx(min(0.7, ACCELERATION * k * period), abs=0.005)
    world.reset(np.random.default_rng(0))
    world.step(Command(0.0, -0.5))
    assert world.observe().velocity.w == pytest.approx(
        -min(0.5, TURN_ACCELERATION * period), abs=0.005
    )
    world.close()


@pytest.mark.parametrize("w", [0.5, -0.5, 0.15, -0.15])
@pytest.mark.parametrize("v", [0.0, 0.7])
def test_the_worlds_turning_rates_are_within_two_percent(v, w):
    """In an open room, through controller and physics, rates come out as commanded."""
    room = COURSE.model_copy(
        update={
            "walls": (
                COURSE.walls[0].model_copy(
                    update={"points": ((-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0))}
                ),
            ),
            "furniture": (),
        }
    )
    world = BulletWorld(room)
    world.reset(np.random.default_rng(0))
    for _ in range(20):
        world.step(Command(v, w))
    before, turned = world.observe().pose, 0.0
    for _ in range(30):
        world.step(Command(v, w))
        after = world.observe().pose
        turned += math.remainder(after.heading - before.heading, math.tau)
        before = after
    assert turned / 3.0 == pytest.approx(w, rel=0.02)
    assert world.observe().velocity == pytest.approx((v, w), rel=0.02, abs=0.003)
    world.close()


def test_the_same_seed_gives_the_same_bits(world):
    """In a process, after laps with crashes, and in a second world: every stream is identical."""
    first = _rows(world, seed=1)
    assert first[:, -1].any()
    assert np.array_equal(first, _rows(world, seed=1))
    other = BulletWorld(COURSE)
    assert np.array_equal(first, _rows(other, seed=1))
    other.close()


def test_another_seed_gives_other_noise_and_the_same_motion(world):
    """The lap's random numbers are the laser's: the chair goes the same way."""
    one, two = _rows(world, seed=1), _rows(world, seed=2)
    assert np.array_equal(one[:, :6], two[:, :6])
    assert not np.array_equal(one[:, 6:186], two[:, 6:186])


def test_both_casters_drive_the_same_lap(world):
    """With PyBullet's rays the readings agree to the millimetre of the sensor's resolution."""
    other = BulletWorld(COURSE, laser=LaserSettings(caster="pybullet"))
    one, two = _rows(world, seed=3, steps=60), _rows(other, seed=3, steps=60)
    assert np.array_equal(one[:, :6], two[:, :6])
    apart = np.abs(one[:, 6:186] - two[:, 6:186])
    assert np.mean(apart > 1.5e-3) < 1e-3
    other.close()


def test_the_clearance_is_the_footprints_distance(world):
    """At every step the clearance is what shapely measures, 0 in contact."""
    world.reset(np.random.default_rng(0))
    rng = np.random.default_rng(5)
    for _ in range(80):
        world.step(Command(rng.uniform(0.2, 0.7), rng.uniform(-0.5, 0.5)))
        seen = world.observe()
        assert seen.clearance_m == pytest.approx(footprint(*seen.pose).distance(PLAN), abs=1e-9)


def test_contacts_are_counted_while_the_chair_pushes(world):
    """Driven into the wall without a guard, contact is reported and the wall holds."""
    world.reset(np.random.default_rng(0))
    contacts = []
    for _ in range(80):
        world.step(Command(0.7, 0.3))
        contacts.append(world.observe().contact)
        assert footprint(*world.observe().pose).intersection(PLAN).area < 0.008
    assert contacts[0] is False
    assert contacts[-1] is True
    assert world.observe().clearance_m < 0.01


def test_the_chair_does_not_leap_off_when_it_comes_free(world):
    """After pushing a wall, reversing starts from what speed is left, not from full ahead."""
    world.reset(np.random.default_rng(0))
    for _ in range(80):
        world.step(Command(0.7, 0.3))
    world.step(Command(-0.7, 0.0))
    assert world.observe().velocity.v < 0.05
    for _ in range(10):
        world.step(Command(-0.7, 0.0))
    assert not world.observe().contact
    assert world.observe().velocity.v < -0.4


def test_the_guard_keeps_wild_laps_clean(world):
    """In the physics too: 40 s of constant full-speed commands, guarded, touch nothing."""
    for seed in range(3):
        rng = np.random.default_rng(seed)
        world.reset(np.random.default_rng(seed))
        for k in range(400):
            if k % 15 == 0:
                command = Command(rng.choice([0.7, 0.7, -0.5]), rng.uniform(-0.5, 0.5))
            world.step(world.safeguard(command))
            assert not world.observe().contact


def test_scans_come_ten_times_a_second():
    """At 20 Hz every second step keeps the scan before; on request each step has its own."""
    world = BulletWorld(COURSE, period=0.05)
    world.reset(np.random.default_rng(0))
    scans = [world.observe().ranges]
    for _ in range(4):
        world.step(Command(0.5, 0.0))
        scans.append(world.observe().ranges)
    fresh = [not np.array_equal(a, b) for a, b in itertools.pairwise(scans)]
    assert fresh == [False, True, False, True]
    world.close()
    world = BulletWorld(COURSE, period=0.05, scan_period=0.05)
    world.reset(np.random.default_rng(0))
    first = world.observe().ranges
    world.step(Command(0.5, 0.0))
    assert not np.array_equal(first, world.observe().ranges)
    world.close()


def test_the_models_laser_may_end_sooner_than_the_laser(world):
    """Segments end at ``model_reach_m``; drivers' readings and everything else stay as they are."""
    near = BulletWorld(COURSE, laser=LaserSettings(model_reach_m=2.0))
    rows, ended = _rows(world, 4, steps=40), _rows(near, 4, steps=40)
    near.close()
    segments = slice(rows.shape[1] - 2 - N_SEGMENTS, rows.shape[1] - 2)
    assert (rows[:, segments] > 2.0).any()
    rows[:, segments] = np.minimum(rows[:, segments], 2.0)
    np.testing.assert_array_equal(rows, ended)


def test_a_world_must_be_reset_first():
    """Without a start there is nothing to observe."""
    world = BulletWorld(COURSE)
    with pytest.raises(RuntimeError, match="reset"):
        world.observe()
    with pytest.raises(RuntimeError, match="reset"):
        world.step(STILL)
    world.close()


def test_a_command_must_be_finite(world):
    """NaN from a driver is an error that says so, not a chair that vanishes."""
    world.reset(np.random.default_rng(0))
    with pytest.raises(ValueError, match="finite"):
        world.step(Command(math.nan, 0.0))


def test_noise_free_readings_start_at_the_lasers_mount(world):
    """The scan's rays start 0.6 m ahead of the axle: straight ahead they meet the plan there."""
    world.reset(np.random.default_rng(0))
    seen = world.observe()
    x, y, heading = seen.pose
    sx, sy = x + LASER_AHEAD * math.cos(heading), y + LASER_AHEAD * math.sin(heading)
    for bearing, reading in zip(world.bearings[::12], seen.ranges[::12], strict=True):
        end = (sx + 4.095 * math.cos(heading + bearing), sy + 4.095 * math.sin(heading + bearing))
        hit = shapely.LineString([(sx, sy), end]).intersection(PLAN.boundary)
        truth = hit.distance(shapely.Point(sx, sy)) if not hit.is_empty else LASER_RANGE
        assert reading == pytest.approx(min(truth, LASER_RANGE), abs=0.02 * max(truth, 1.0))
