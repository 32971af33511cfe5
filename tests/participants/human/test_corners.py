"""Sharp corners are found where the way turns by more than 60 degrees, and nowhere else."""

import math

import numpy as np
import pytest

from participants.human.corners import sharp_corners
from protocols.course.route import Route, plan_route


def way(*turns):
    """Return a way of straight legs of 2 m with turns between, in degrees, left positive."""
    points, heading = [np.zeros(2)], 0.0
    for turn in (*turns, 0):
        for _ in range(40):
            points.append(points[-1] + 0.05 * np.array([math.cos(heading), math.sin(heading)]))
        heading += math.radians(turn)
    return Route(np.array(points), ())


@pytest.mark.parametrize(("turn", "count"), [(45, 0), (59, 0), (61, 1), (-90, 1), (-135, 1)])
def test_sixty_degrees_make_a_corner_sharp(turn, count):
    """Softer bends are none (section IV of the paper)."""
    assert len(sharp_corners(way(turn))) == count


def test_a_corner_has_its_place_and_its_turn():
    """It lies around the bend, and right turns are negative."""
    (corner,) = sharp_corners(way(-90))
    assert corner.start < 2.0 < corner.end
    assert corner.turn == pytest.approx(math.radians(-90), abs=0.05)


def test_left_and_right_corners_are_told_apart():
    """Two corners in a row keep their own turns."""
    left, right = sharp_corners(way(90, -90))
    assert left.turn > 0 > right.turn


def test_the_default_course_has_two(lab_office):
    """R1 and R2, both to the right; the bends on the way back are soft."""
    turns = [math.degrees(corner.turn) for corner in sharp_corners(plan_route(lab_office))]
    assert turns == pytest.approx([-135.0, -135.0], abs=25.0)
