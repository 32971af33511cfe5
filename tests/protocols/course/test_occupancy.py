"""The raster of a course."""

import numpy as np
import pytest
import shapely

from protocols.course.obstacles import floor_plan
from protocols.course.occupancy import occupancy
from protocols.load import load_course, shipped_courses


@pytest.mark.parametrize("name", shipped_courses())
def test_distances_agree_with_the_plan(name):
    """A free cell's distance is the plan's; one inside an obstacle is not free."""
    course = load_course(name)
    plan = floor_plan(course)
    grid = occupancy(course, cell=0.1)
    rng = np.random.default_rng(0)
    for row, column in rng.integers((0, 0), grid.free.shape, (400, 2)):
        point = shapely.Point(*grid.centre(int(row), int(column)))
        distance = plan.distance(point)
        assert grid.distance[row, column] == pytest.approx(distance, abs=1e-9)
        assert grid.free[row, column] == (grid.distance[row, column] > 0)


def test_index_and_centre_are_inverse(ring_course):
    """A cell's centre lies in that cell; points outside belong to the edge."""
    grid = occupancy(ring_course)
    assert grid.index(*grid.centre(7, 11)) == (7, 11)
    x, y = grid.centre(7, 11)
    assert grid.index(x + 0.4 * grid.cell, y - 0.4 * grid.cell) == (7, 11)
    assert grid.index(-1e3, 1e3) == (grid.free.shape[0] - 1, 0)


def test_everything_that_matters_is_on_the_raster(ring_course):
    """Start, gates, centreline and walls lie inside, not on the edge."""
    grid = occupancy(ring_course)
    rows, columns = grid.free.shape
    for x, y in [*ring_course.centreline, *ring_course.walls[0].points]:
        row, column = grid.index(x, y)
        assert 0 < row < rows - 1
        assert 0 < column < columns - 1
