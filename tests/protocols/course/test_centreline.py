"""Arc length along the lap."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from protocols.course.centreline import REACH, Centreline
from protocols.course.schema import Course
from protocols.load import load_course

LAB = Centreline(load_course("lab-office"))


@pytest.fixture
def line(ring_course: Course) -> Centreline:
    """Return the ring's centreline."""
    return Centreline(ring_course)


@settings(deadline=None)  # the first example compiles
@given(st.floats(-6, 6), st.floats(-8, 3))
def test_the_nearest_of_all_agrees_with_shapely(x, y):
    """Without a hint, the projection is the nearest point of the whole line."""
    arc, offset = LAB.locate(x, y)
    line = shapely.LineString(LAB.points)
    point = shapely.Point(x, y)
    assert abs(offset) == pytest.approx(line.distance(point), abs=1e-9)
    there = LAB.point(arc)
    assert math.dist(there[:2], (x, y)) == pytest.approx(abs(offset), abs=1e-9)


@settings(deadline=None)
@given(st.floats(0, 1), st.floats(-0.4, 0.4))
def test_a_point_beside_the_line_projects_back(share, offset):
    """A point left of the line by d has offset d; the arc comes back where the line is straight."""
    arc = share * LAB.length
    x, y, heading = LAB.point(arc)
    found, side = LAB.locate(x - offset * math.sin(heading), y + offset * math.cos(heading), arc)
    assert abs(side) <= abs(offset) + 1e-9
    assert found == pytest.approx(arc, abs=0.45)
    if LAB.section(arc).kind == "straight" and LAB.section(found).kind == "straight":
        assert side == pytest.approx(offset, abs=1e-6)


def test_a_neighbouring_leg_does_not_steal_the_projection(line):
    """Start and finish lie on each other: the hint keeps the lap's place."""
    assert line.locate(0.45, 0.1, near=14.0) == pytest.approx((14.45, 0.1))
    assert line.locate(1.1, 0.1, near=0.0) == pytest.approx((0.1, 0.1))


def test_driving_the_lap_gives_rising_arcs():
    """Followed with its own hints, the projection of a lap rises steadily from 0 to the end."""
    arcs = [0.0]
    for arc in np.arange(0, LAB.length, 0.05):
        x, y, heading = LAB.point(arc)
        sway = 0.3 * math.sin(3 * arc)
        arcs.append(
            LAB.locate(x - sway * math.sin(heading), y + sway * math.cos(heading), arcs[-1])[0]
        )
    assert np.diff(arcs).min() > -0.3
    assert arcs[-1] == pytest.approx(LAB.length, abs=0.1)


def test_the_projection_stays_within_reach_of_its_hint(line):
    """However far the point is, the projection moves by no more than it may."""
    arc, _ = line.locate(0.0, -3.0, near=2.0)
    assert arc <= 2.0 + REACH


def test_ends_are_clamped(line):
    """Before the start the arc is 0, past the finish it is the length."""
    assert line.point(-3).x == 1.0
    assert line.point(99)[:2] == pytest.approx((0.5, 0.0))
    assert line.locate(0.2, 0.0, near=0.0)[0] == 0.0
    assert line.locate(3.0, 0.0, near=line.length)[0] == line.length


def test_sections_cover_the_line(line):
    """Sections follow one another without gaps, and a boundary belongs to the later one."""
    assert [(s.name, s.start, s.end) for s in line.sections] == [
        ("out", 0.0, 3.0),
        ("corner", 3.0, 4.0),
        ("back", 4.0, pytest.approx(line.length)),
    ]
    assert line.section(0.0).name == "out"
    assert line.section(3.0).name == "corner"
    assert line.section(99.0).name == "back"
