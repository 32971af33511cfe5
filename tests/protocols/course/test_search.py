"""The cheapest path is a drivable one through the gates, and as short as it can be."""

import itertools

import numpy as np
import pytest

from protocols.course.gates import GateCounter
from protocols.course.occupancy import occupancy
from protocols.course.schema import Course
from protocols.course.search import cheapest_path
from protocols.files.errors import InputError
from protocols.wheelchair import WIDTH


def box_course(gates, walls=()):
    """Return an empty hall of 6 by 6 m with the start at its middle, heading east."""
    hall = {"name": "hall", "closed": True, "points": [(-3, -3), (3, -3), (3, 3), (-3, 3)]}
    return Course.model_validate(
        {
            "schema": 1,
            "name": "hall",
            "title": "A hall",
            "walls": [hall, *walls],
            "start": {"x": 0, "y": 0, "heading": 0},
            "gates": gates,
            "centreline": [(0, 0), (2, 0)],
            "sections": [{"name": "way", "kind": "straight"}],
        }
    )


def length(path):
    """Return the length of a polyline, m."""
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def test_path_passes_the_gates_in_order_and_keeps_the_chairs_width(lab_office):
    """On the default course: every gate forwards, never nearer to a wall than half the chair."""
    raster = occupancy(lab_office, 0.1)
    path = cheapest_path(lab_office, raster)
    counter = GateCounter(lab_office)
    for a, b in itertools.pairwise(path):
        counter.advance(tuple(a), tuple(b))
    assert counter.finished
    rooms = [raster.distance[raster.index(x, y)] for x, y in path]
    assert min(rooms) >= WIDTH / 2


def test_a_free_way_is_straight():
    """Without anything in the way the path is the straight line."""
    course = box_course([{"name": "F", "left": (1.5, 1), "right": (1.5, -1)}])
    path = cheapest_path(course, occupancy(course, 0.1))
    assert length(path) == pytest.approx(1.5, abs=0.15)
    assert np.abs(path[:, 1]).max() < 0.11


def test_a_gate_counts_in_its_direction_only():
    """A gate that is to be passed westwards has to be reached from its other side."""
    gate = {"name": "F", "left": (1.5, -1), "right": (1.5, 1)}
    course = box_course([gate])
    path = cheapest_path(course, occupancy(course, 0.1))
    counter = GateCounter(course)
    for a, b in itertools.pairwise(path):
        assert not counter.finished
        counter.advance(tuple(a), tuple(b))
    assert counter.finished
    assert path[:, 0].max() > 1.5 > path[-1, 0]


def test_a_closed_course_is_refused():
    """Walled in, one is told which gate cannot be reached."""
    box = {"name": "box", "closed": True, "points": [(-1, -1), (1, -1), (1, 1), (-1, 1)]}
    course = box_course([{"name": "F", "left": (2, 0.5), "right": (2, -0.5)}], [box])
    with pytest.raises(InputError, match=r"F: no way of the chair's width \(0.55 m\) leads there"):
        cheapest_path(course, occupancy(course, 0.1))
