"""Pictures of a robot's map."""

import numpy as np
import pytest

from analysis.figures.imported_map import map_with_grid
from protocols.importing.map.ros_map import RosMap


def _map(tmp_path, rows, columns, origin=(0.0, 0.0, 0.0)):
    free = np.ones((rows, columns), dtype=bool)
    free[:, 11] = False
    return RosMap(tmp_path / "map.yaml", free, ~free, 0.05, origin, "")


@pytest.mark.parametrize("columns", [40, 4500])
def test_a_wall_of_one_cell_is_drawn(columns, tmp_path):
    """Also on a map so large that several cells become one in the picture."""
    (mesh,) = map_with_grid(_map(tmp_path, 8, columns)).axes[0].collections
    shades = np.asarray(mesh.get_array()).reshape(-1, mesh.get_coordinates().shape[1] - 1)
    corners = mesh.get_coordinates()[0, :, 0]
    (dark,) = np.flatnonzero((shades < 0.5).all(axis=0))
    assert corners[dark] <= 11.5 * 0.05 <= corners[dark + 1]


def test_a_turned_map_lies_where_its_origin_says(tmp_path):
    """The far corner of the drawn cells is the world's."""
    drawn = _map(tmp_path, 20, 40, (1.0, -2.0, 0.5))
    (mesh,) = map_with_grid(drawn).axes[0].collections
    np.testing.assert_allclose(mesh.get_coordinates()[-1, -1], drawn.outward(2.0, 1.0))


@pytest.mark.parametrize(("cells", "step"), [(100, 0.5), (300, 1.0), (1200, 5.0)])
def test_the_grid_has_whole_steps_that_both_axes_share(cells, step, tmp_path):
    """As fine as can be read."""
    axes = map_with_grid(_map(tmp_path, 20, cells)).axes[0]
    for axis in (axes.xaxis, axes.yaxis):
        assert np.diff(axis.get_major_locator()()) == pytest.approx(step)
