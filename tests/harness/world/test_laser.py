"""What the scanner measures, and its 15 segments."""

import math

import numpy as np
import pytest

from harness.world.bullet_caster import BulletCaster
from harness.world.laser import (
    ACCURACY,
    FULL_STEPS,
    NEAREST,
    REACH,
    SIGMAS,
    SPAN,
    Laser,
    deviation,
    ray_bearings,
)
from harness.world.ray_sweep import RaySweep
from lad.inputs import N_SEGMENTS
from protocols.course.obstacles import Box, obstacle_boxes
from protocols.load import load_course
from protocols.pose import Pose
from protocols.wheelchair import LASER_HEIGHT, LASER_RANGE

ORIGIN = Pose(0.0, 0.0, 0.0)


def _ahead(distance, height=1.0):
    return [Box(distance + 0.05, 0.0, math.pi / 2, 100.0, 0.1, height, "wall")]


def test_the_full_scan_has_the_sensors_steps():
    """682 rays are 360/1024 degrees apart and look 119.7 degrees to either side."""
    bearings = ray_bearings(FULL_STEPS)
    assert np.diff(bearings) == pytest.approx(math.tau / 1024)
    assert math.degrees(SPAN) == pytest.approx(239.41, abs=0.01)
    assert bearings[0] == -bearings[-1] < 0


@pytest.mark.parametrize("distance", [0.3, 0.9, 2.0, 3.5])
def test_the_noise_is_the_published_accuracy(distance):
    """Unbiased; 99.7% of readings lie within 10 mm up to 1 m and within 1% beyond."""
    laser = Laser(_ahead(distance), 181)
    rng = np.random.default_rng(1)
    readings = np.array([laser.scan(ORIGIN, rng)[0][90] for _ in range(4000)])
    accuracy = max(0.010, 0.01 * distance)
    assert readings.mean() == pytest.approx(distance, abs=4 * accuracy / 3 / math.sqrt(4000))
    assert readings.std() == pytest.approx(accuracy / 3, rel=0.05)
    assert np.mean(np.abs(readings - distance) <= accuracy + 5e-4) > 0.995
    assert deviation(distance) == pytest.approx(accuracy / SIGMAS)


def test_rays_err_independently():
    """Neighbouring rays and successive scans do not share their errors."""
    laser = Laser(_ahead(1.0), 181)
    rng = np.random.default_rng(2)
    truth = 1.0 / np.cos(laser.bearings[80:101])
    errors = np.array([laser.scan(ORIGIN, rng)[0][80:101] - truth for _ in range(2000)])
    correlations = np.corrcoef(errors.T)[np.triu_indices(21, 1)]
    assert np.abs(correlations).max() < 0.1
    assert abs(np.corrcoef(errors[:-1, 10], errors[1:, 10])[0, 1]) < 0.1


def test_readings_are_whole_millimetres_within_the_range():
    """The sensor reports millimetres, nothing below 20 mm, and 4 m for anything farther."""
    rng = np.random.default_rng(3)
    near, _ = Laser(_ahead(0.005), 181).scan(ORIGIN, rng)
    assert near.min() == NEAREST
    empty, segments = Laser([], 181).scan(ORIGIN, rng)
    assert (empty == LASER_RANGE).all()
    assert (segments == LASER_RANGE).all()
    ranges, _ = Laser(_ahead(1.234), 181).scan(ORIGIN, rng)
    assert ranges * 1000 == pytest.approx(np.round(ranges * 1000))


def test_noise_decides_at_the_edge_of_the_range():
    """A wall just past 4 m is sometimes measured just before it, never past it."""
    laser = Laser(_ahead(4.005), 181)
    rng = np.random.default_rng(4)
    readings = np.array([laser.scan(ORIGIN, rng)[0][90] for _ in range(500)])
    assert readings.max() == LASER_RANGE
    assert 0.05 < np.mean(readings < LASER_RANGE) < 0.6
    assert LASER_RANGE < REACH


def test_the_seed_decides():
    """Two scanners with the same random numbers read the same; with others, others."""
    boxes = obstacle_boxes(load_course("lab-office"))
    a, _ = Laser(boxes, 180).scan(ORIGIN, np.random.default_rng(5))
    b, _ = Laser(boxes, 180).scan(ORIGIN, np.random.default_rng(5))
    c, _ = Laser(boxes, 180).scan(ORIGIN, np.random.default_rng(6))
    assert np.array_equal(a, b)
    assert not np.array_equal(a, c)


@pytest.mark.parametrize("rays", [21, 180, 181, 682, 2000])
def test_segments_are_the_nearest_reading_of_12_degrees(rays):
    """Each of the 15 is the minimum over the rays in its share of the front half circle."""
    laser = Laser(obstacle_boxes(load_course("lab-office")), rays)
    ranges, segments = laser.scan(Pose(0.6, 0.1, 0.2), np.random.default_rng(7))
    degrees = np.degrees(laser.bearings)
    assert segments.shape == (N_SEGMENTS,)
    for i, segment in enumerate(segments):
        low = -90 + 12 * i
        inside = (degrees >= low - 1e-6) & (degrees < low + 12 - 1e-6)
        assert inside.any()
        assert segment == ranges[inside].min()


def test_segments_run_from_right_to_left():
    """A post on the right shows in the first segments, one on the left in the last."""
    right = [Box(0.5, -1.0, 0.0, 0.2, 0.2, 1.0, "post")]
    _, segments = Laser(right, 180).scan(ORIGIN, np.random.default_rng(8))
    assert np.argmin(segments) < 4
    assert (segments[8:] == LASER_RANGE).all()


def test_few_rays_stand_for_the_segments_they_are_nearest_to():
    """With fewer rays than segments none is empty: the nearest ray stands in."""
    laser = Laser(_ahead(1.0), 15)
    ranges, segments = laser.scan(ORIGIN, np.random.default_rng(9))
    assert segments.shape == (N_SEGMENTS,)
    assert set(segments) <= set(ranges)


def test_what_is_lower_than_the_laser_is_not_seen():
    """A threshold on the floor is below the plane of the rays, for both casters."""
    for caster in (RaySweep, BulletCaster):
        rng = np.random.default_rng(10)
        low, _ = Laser(_ahead(1.0, LASER_HEIGHT - 0.01), 181, caster).scan(ORIGIN, rng)
        assert (low == LASER_RANGE).all()
        high, _ = Laser(_ahead(1.0, LASER_HEIGHT + 0.01), 181, caster).scan(ORIGIN, rng)
        assert high[90] == pytest.approx(1.0, abs=2 * ACCURACY)


def test_pybullets_rays_stay_selectable():
    """With the other caster the same scan comes out."""
    boxes = obstacle_boxes(load_course("lab-office"))
    a, _ = Laser(boxes, 180, RaySweep).scan(ORIGIN, np.random.default_rng(11))
    b, _ = Laser(boxes, 180, BulletCaster).scan(ORIGIN, np.random.default_rng(11))
    assert a == pytest.approx(b, abs=1e-3)
