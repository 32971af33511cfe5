"""The discs stand for the chair's rectangle, on the safe side."""

import numpy as np

from protocols.course.footprint import DISC_RADIUS, SWING, disc_centres
from protocols.wheelchair import FRONT, REAR, WIDTH


def test_the_discs_cover_the_rectangle():
    """Every point of the chair's outline and inside lies in a disc."""
    xs, ys = np.meshgrid(np.linspace(-REAR, FRONT, 60), np.linspace(-WIDTH / 2, WIDTH / 2, 40))
    points = np.column_stack([xs.ravel(), ys.ravel()])
    apart = np.linalg.norm(points[:, None] - disc_centres()[None], axis=2)
    assert (apart.min(axis=1) <= DISC_RADIUS + 1e-12).all()


def test_the_discs_reach_less_than_a_decimetre_past_the_rectangle():
    """The chair is made bigger by centimetres only."""
    for x, y in disc_centres():
        assert x + DISC_RADIUS - FRONT < 0.08
        assert abs(y) + DISC_RADIUS - WIDTH / 2 < 0.04
    assert np.hypot(FRONT, WIDTH / 2) - DISC_RADIUS <= SWING
