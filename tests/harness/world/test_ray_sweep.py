"""Our rays against closed forms and against PyBullet's."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from harness.world.bullet_caster import BulletCaster
from harness.world.laser import REACH, ray_bearings
from harness.world.ray_sweep import RaySweep, _bearing
from protocols.course.obstacles import Box, floor_plan, obstacle_boxes
from protocols.course.schema import Course
from protocols.load import load_course, shipped_courses
from protocols.pose import Pose

BEARINGS = ray_bearings(180)


def _free_poses(course: Course, n: int, rng: np.random.Generator):
    """Return sensor poses outside all obstacles, near the lap."""
    run = floor_plan(course)
    line = np.array(course.centreline)
    poses = []
    while len(poses) < n:
        x, y = line[rng.integers(len(line))] + rng.normal(0, 0.5, 2)
        if run.distance(shapely.Point(x, y)) > 1e-3:
            poses.append(Pose(float(x), float(y), float(rng.uniform(-math.pi, math.pi))))
    return poses


def _grazing(course: Course, pose: Pose, bearings: np.ndarray) -> np.ndarray:
    """Return which rays pass within a millimetre of a box's corner."""
    corners = np.concatenate([box.corners() for box in obstacle_boxes(course)]) - pose[:2]
    ways = np.stack([np.cos(bearings + pose.heading), np.sin(bearings + pose.heading)])
    beside = np.abs(corners[:, :1] * ways[1] - corners[:, 1:] * ways[0])
    return (beside < 1e-3).any(axis=0)


@pytest.mark.parametrize("rays", [21, 180, 682])
@pytest.mark.parametrize("name", shipped_courses())
def test_the_sweep_agrees_with_rays_of_pybullet(name, rays):
    """On every shipped course within 1e-6 m, but for rays that graze a corner."""
    course = load_course(name)
    boxes = obstacle_boxes(course)
    bearings = ray_bearings(rays)
    ours = RaySweep(boxes, bearings, REACH)
    theirs = BulletCaster(boxes, bearings, REACH)
    differing = 0
    poses = _free_poses(course, 300, np.random.default_rng(rays))
    for pose in poses:
        apart = np.abs(ours.cast(pose) - theirs.cast(pose)) > 1e-6
        differing += int(apart.sum())
        assert not (apart & ~_grazing(course, pose, bearings)).any()
    assert differing <= 1e-3 * rays * len(poses)


places = st.floats(-4, 4)
sizes = st.floats(0.05, 3)


@settings(deadline=None, max_examples=50)
@given(
    st.lists(st.tuples(places, places, places, sizes, sizes), max_size=6),
    st.floats(-math.pi, math.pi),
)
def test_the_sweep_agrees_with_geometry(rows, heading):
    """Each ray ends where shapely says the first obstacle is, wherever the sensor stands."""
    boxes = [Box(*row, 1.0, "b") for row in rows]
    polygons = [shapely.Polygon(box.corners()) for box in boxes]
    if any(polygon.distance(shapely.Point(0, 0)) < 1e-3 for polygon in polygons):
        return  # a sensor inside a box has its own test
    outlines = shapely.union_all([p.exterior for p in polygons])
    corners = [corner for box in boxes for corner in box.corners()]
    bearings = ray_bearings(40)
    found = RaySweep(boxes, bearings, REACH).cast(Pose(0.0, 0.0, heading))
    for bearing, distance in zip(bearings + heading, found, strict=True):
        way = np.array([math.cos(bearing), math.sin(bearing)])
        if any(abs(c[0] * way[1] - c[1] * way[0]) < 1e-6 for c in corners):
            continue
        hits = shapely.LineString([(0, 0), tuple(REACH * way)]).intersection(outlines)
        expected = min((math.hypot(*p) for p in shapely.get_coordinates(hits)), default=REACH)
        assert distance == pytest.approx(expected, abs=1e-6)


def test_a_wall_straight_ahead_has_the_closed_form():
    """In front of a long wall at distance d, the ray at bearing b measures d / cos b."""
    wall = Box(2.05, 0.0, math.pi / 2, 100.0, 0.1, 1.0, "wall")
    ranges = RaySweep([wall], BEARINGS, REACH).cast(Pose(0.0, 0.0, 0.0))
    expected = np.where(np.cos(BEARINGS) > 0, 2.0 / np.cos(BEARINGS), REACH)
    expected[(expected > REACH) | (expected < 0)] = REACH
    assert ranges == pytest.approx(expected, abs=1e-12)


def test_a_box_around_the_sensor_is_seen_from_inside():
    """A sensor inside a box sees its walls, as PyBullet's mesh shows them."""
    room = [Box(0.0, 0.0, 0.3, 4.0, 2.0, 1.0, "room")]
    pose = Pose(0.2, -0.1, 1.0)
    ours = RaySweep(room, BEARINGS, REACH).cast(pose)
    theirs = BulletCaster(room, BEARINGS, REACH).cast(pose)
    assert ours == pytest.approx(theirs, abs=1e-6)
    assert ours.max() < REACH


def test_nothing_around_means_reach():
    """Without boxes every ray goes all the way; boxes farther than that are not met."""
    far = [Box(10.0, 0.0, 0.0, 1.0, 1.0, 1.0, "far")]
    for boxes in ([], far):
        assert (RaySweep(boxes, BEARINGS, REACH).cast(Pose(0.0, 0.0, 0.0)) == REACH).all()


@settings(deadline=None)
@given(st.floats(-10, 10), st.floats(-10, 10))
def test_the_quick_bearing_is_good_enough(x, y):
    """The approximate bearing is within half the slack that rays are tried in."""
    if math.hypot(x, y) < 1e-6:
        return
    assert abs(math.remainder(_bearing(x, y) - math.atan2(y, x), math.tau)) < 5e-4
