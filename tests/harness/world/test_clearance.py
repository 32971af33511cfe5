"""Distances from the chair's footprint."""

import math

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

from harness.world.clearance import FAR, box_table, clearance
from protocols.course.drivable import footprint
from protocols.course.obstacles import Box, floor_plan, obstacle_boxes
from protocols.load import load_course
from protocols.pose import Pose

metres = st.floats(-3, 3)
angles = st.floats(-math.pi, math.pi)
boxes = st.builds(
    Box, metres, metres, angles, st.floats(0.01, 3), st.floats(0.01, 3), st.just(1.0), st.just("b")
)
poses = st.builds(Pose, metres, metres, angles)


@settings(deadline=None)  # the first example compiles
@given(boxes, poses)
def test_the_distance_to_a_box_is_exact(box, pose):
    """Apart from each other, footprint and box are as far apart as shapely says."""
    expected = footprint(*pose).distance(shapely.Polygon(box.corners()))
    found = clearance(box_table([box]), pose)
    assert max(found, 0.0) == pytest.approx(expected, abs=1e-9)


@settings(deadline=None)
@given(boxes, poses)
def test_the_depth_of_an_overlap_parts_them(box, pose):
    """Shifted apart by the overlap's depth along the best of the edge directions, none is left."""
    depth = -clearance(box_table([box]), pose)
    chair, other = footprint(*pose), shapely.Polygon(box.corners())
    if depth <= 1e-6:
        return
    assert chair.intersects(other)
    directions = [pose.heading, box.heading]
    shifted = [
        shapely.affinity.translate(
            chair, shift * depth * math.cos(a + turn), shift * depth * math.sin(a + turn)
        )
        for a in directions
        for turn in (0.0, math.pi / 2)
        for shift in (1 + 1e-6, -1 - 1e-6)
    ]
    assert any(not s.intersects(other) for s in shifted)


def test_the_nearest_box_counts():
    """On the default course the distance is that to the union of all obstacles."""
    course = load_course("lab-office")
    table, run = box_table(obstacle_boxes(course)), floor_plan(course)
    rng = np.random.default_rng(0)
    for x, y, heading in rng.uniform((-5, -7, -3), (5, 2, 3), (300, 3)):
        expected = footprint(x, y, heading).distance(run)
        found = clearance(table, Pose(x, y, heading))
        assert max(found, 0.0) == pytest.approx(expected, abs=1e-9)


def test_an_empty_room_is_far_from_everything():
    """Without boxes the distance is a fixed large number."""
    assert clearance(box_table([]), Pose(0.0, 0.0, 0.0)) == FAR
