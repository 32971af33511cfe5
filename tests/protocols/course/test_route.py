"""A route is a smooth way by arc length, and one's place on it stays between the right gates."""

import math

import numpy as np
import pytest

from protocols.course.occupancy import occupancy
from protocols.course.route import Route, plan_route
from protocols.pose import Pose
from protocols.wheelchair import WIDTH


@pytest.fixture
def bend():
    """Return a way of 2 m east and 2 m south with a gate at the corner."""
    east = np.column_stack([np.linspace(0, 2, 41), np.zeros(41)])
    south = np.column_stack([np.full(40, 2.0), np.linspace(-0.05, -2, 40)])
    return Route(np.vstack([east, south]), (2.0, 4.0))


def test_arc_lengths_points_and_turn(bend):
    """Arc lengths are lengths, directions those of the way, right turns negative."""
    assert bend.length == pytest.approx(4.0)
    assert bend.point(1.0) == pytest.approx(Pose(1.0, 0.0, 0.0))
    assert bend.turn(1.0, 3.0) == pytest.approx(-math.pi / 2)
    assert bend.point(99.0)[:2] == pytest.approx((2.0, -2.0))


def test_offset_is_positive_to_the_left(bend):
    """A point left of the way has a positive distance, whichever way it leads."""
    assert bend.locate(Pose(1.0, 0.3, 0.0), 0).offset == pytest.approx(0.3, abs=0.01)
    assert bend.locate(Pose(2.2, -1.0, 0.0), 1).offset == pytest.approx(0.2, abs=0.01)


def test_nobody_is_past_a_gate_that_was_not_passed(bend):
    """The place on the way stays before the next gate and behind the last one."""
    assert bend.locate(Pose(2.0, -1.0, 0.0), 0).arc <= 2.0
    assert bend.locate(Pose(1.0, 0.0, 0.0), 1).arc >= 2.0


def test_a_place_near_the_last_one_is_preferred_unless_it_is_far_off(bend):
    """One does not jump to another leg, except when one is lost."""
    slipped, lost = Pose(0.1, -0.3, 0.0), Pose(0.0, -0.6, 0.0)
    assert bend.locate(slipped, 0, near=1.6).arc == pytest.approx(0.6, abs=0.06)
    assert bend.locate(lost, 0, near=2.0).arc == pytest.approx(0.0, abs=0.03)


def test_the_plan_of_the_default_course_is_smooth_and_drivable(lab_office):
    """Points lie evenly, the direction never jumps, and the chair fits all along."""
    route = plan_route(lab_office)
    steps = np.hypot(*np.diff(route.points, axis=0).T)
    assert steps.max() < 0.06
    assert np.abs(np.diff(route.headings)).max() < 0.3
    raster = occupancy(lab_office)
    rooms = [raster.distance[raster.index(x, y)] for x, y in route.points]
    assert min(rooms) > WIDTH / 2
    assert len(route.gate_arcs) == 3
    assert list(route.gate_arcs) == sorted(route.gate_arcs)
    assert plan_route(lab_office) is route
