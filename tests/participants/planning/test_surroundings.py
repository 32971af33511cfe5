"""The field from the map agrees with exact distances to the course's obstacles."""

import math

import numpy as np
import pytest
import shapely

from participants.planning.field import ASIDE, BEHIND, CELL, COLUMNS, FAR, ROWS
from participants.planning.surroundings import known_raster, map_field
from protocols.course.obstacles import floor_plan
from protocols.pose import Pose


@pytest.mark.parametrize(
    "pose", [Pose(0.3, 0.1, 0.4), Pose(-3.2, -4.0, 2.0), Pose(2.2, -0.5, -1.0)]
)
def test_map_field_is_a_close_lower_bound(lab_office, pose):
    """Around the chair, behind it too, no cell promises more than the floor plan allows."""
    field = map_field(known_raster(lab_office), pose).known
    x, y = np.meshgrid(CELL * np.arange(COLUMNS) - BEHIND, CELL * np.arange(ROWS) - ASIDE)
    c, s = math.cos(pose.heading), math.sin(pose.heading)
    points = shapely.points(pose.x + c * x - s * y, pose.y + s * x + c * y)
    true = np.minimum(shapely.distance(floor_plan(lab_office), points), FAR)
    assert (field <= true + 0.02).all()
    # Beyond the raster the map knows nothing, and the nearest it knows counts.
    raster = known_raster(lab_office)
    height, width = np.array(raster.free.shape) * raster.cell
    ax, ay = shapely.get_x(points) - raster.origin[0], shapely.get_y(points) - raster.origin[1]
    known = (ax > 0) & (ax < width - raster.cell) & (ay > 0) & (ay < height - raster.cell)
    assert (true - field)[known].max() < 0.12


def test_one_raster_serves_all(lab_office):
    """A course is rasterised once."""
    assert known_raster(lab_office) is known_raster(lab_office)
