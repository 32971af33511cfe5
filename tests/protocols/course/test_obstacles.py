"""Boxes and outlines of a course."""

import math

import numpy as np
import pytest
import shapely

from protocols.course.obstacles import floor_plan, obstacle_boxes, segments
from protocols.course.schema import Course
from protocols.load import load_course, shipped_courses


def _walled(points, *, closed=False, thickness=0.2):
    wall = {"name": "w", "points": points, "closed": closed, "thickness": thickness}
    return Course.model_validate(
        {
            "schema": 1, "name": "c", "title": "c", "walls": [wall],
            "start": {"x": 0, "y": 0, "heading": 0},
            "gates": [{"name": "F", "left": [9, 1], "right": [9, 0]}],
            "centreline": [[0, 0], [9, 0]], "sections": [{"name": "s", "kind": "straight"}],
        }
    )  # fmt: skip


def test_a_wall_stands_half_its_thickness_to_either_side():
    """A straight wall is one box along its line."""
    (box,) = obstacle_boxes(_walled([[1, 1], [1, 4]]))
    assert (box.cx, box.cy) == pytest.approx((1, 2.5))
    assert box.length == pytest.approx(3)
    assert floor_plan(_walled([[1, 1], [1, 4]])).bounds == pytest.approx((0.9, 1, 1.1, 4))


def test_a_closed_wall_returns_to_its_first_point():
    """A closed polyline of n points has n pieces."""
    assert len(obstacle_boxes(_walled([[0, 0], [3, 0], [3, 3], [0, 3]], closed=True))) == 4


@pytest.mark.parametrize("turn", [10, 45, 90, 120, 135, 170])
def test_bends_leave_no_gap_outside(turn):
    """A wall's outline at a bend covers the wall's mitre, up to a square corner's reach."""
    a = math.radians(turn)
    points = [[0, 0], [2, 0], [2 + 2 * math.cos(a), 2 * math.sin(a)]]
    plan = floor_plan(_walled(points))
    round_joint = shapely.Point(2, 0).buffer(0.1 - 1e-6, quad_segs=64)
    line = shapely.LineString(points).buffer(0.1 - 1e-6, cap_style="flat", join_style="bevel")
    assert plan.buffer(1e-9).contains(line)
    if turn <= 90:
        assert plan.buffer(1e-9).contains(round_joint.intersection(plan.convex_hull))
        mitre = shapely.LineString(points).buffer(0.1, cap_style="flat", join_style="mitre")
        assert plan.symmetric_difference(mitre).area == pytest.approx(0, abs=1e-6)


def test_boxes_never_reach_far_past_a_sharp_bend():
    """At an acute bend a piece reaches past its point by half its thickness, no more."""
    plan = floor_plan(_walled([[0, 0], [2, 0], [0, 0.1]]))
    assert plan.bounds[2] <= 2 + 0.1 + 0.11


def test_furniture_is_turned_about_its_centre(ring_course):
    """A piece of furniture is a box as the file says."""
    box = obstacle_boxes(ring_course)[-1]
    corners = box.corners()
    assert box.name == "bin"
    assert corners.mean(axis=0) == pytest.approx([4.7, 0.7])
    edge = corners[0] - corners[1]
    assert math.atan2(edge[1], edge[0]) == pytest.approx(0.4)
    assert np.hypot(*edge) == pytest.approx(0.3)
    assert shapely.Polygon(corners).exterior.is_ccw


@pytest.mark.parametrize("name", shipped_courses())
def test_segments_are_the_outlines_of_the_boxes(name):
    """Four edges a box, closed, anticlockwise, of the box's size."""
    course = load_course(name)
    boxes = obstacle_boxes(course)
    edges = segments(course).reshape(len(boxes), 4, 2, 2)
    assert np.array_equal(edges[:, :, 1], np.roll(edges[:, :, 0], -1, axis=1))
    lengths = np.linalg.norm(edges[:, :, 1] - edges[:, :, 0], axis=2)
    for box, sides in zip(boxes, lengths, strict=True):
        assert sides == pytest.approx([box.length, box.width] * 2)
