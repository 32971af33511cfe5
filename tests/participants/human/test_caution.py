"""A person slows down for what the scan shows in the way, and passes what is beside it."""

import numpy as np
import pytest

from lad.command import Command
from participants.human.caution import CREEP, slowed
from participants.planning.field import scan_field

BEARINGS = np.radians(np.linspace(-120, 120, 181))


def wall_ahead(distance):
    """Return the field of a wall across the way, m ahead of the laser."""
    front = np.abs(BEARINGS) < 1.3
    return scan_field(np.where(front, distance / np.cos(BEARINGS), 4.0), BEARINGS, 0.6, 4.0)


def corridor(half_width):
    """Return the field of walls to either side, m from the middle."""
    sides = np.abs(np.sin(BEARINGS)) > 0.15
    ranges = np.where(sides, half_width / np.maximum(np.abs(np.sin(BEARINGS)), 1e-9), 4.0)
    return scan_field(np.minimum(ranges, 4.0), BEARINGS, 0.6, 4.0)


def test_a_free_way_changes_nothing():
    """Nothing near: one goes as one wants."""
    wish = Command(0.6, -0.1)
    assert slowed(wall_ahead(3.9), wish, 0.2) == wish


def test_the_nearer_the_wall_the_slower_and_in_time():
    """Speed falls with the distance, and the chair can always stop before the wall."""
    speeds = [slowed(wall_ahead(d), Command(0.6, 0.0), 0.2).v for d in (1.6, 1.0, 0.6, 0.3, 0.12)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[-1] == 0.0
    for speed, distance in zip(speeds, (1.6, 1.0, 0.6, 0.3, 0.12), strict=True):
        assert speed**2 / (2 * 0.4) < distance


def test_a_narrow_place_is_passed_slowly():
    """Between walls a person slows down more with a larger clearance, but does not stop."""
    field = corridor(0.5)
    calm, timid = (slowed(field, Command(0.6, 0.0), margin).v for margin in (0.15, 0.4))
    assert CREEP <= timid < calm <= 0.6


@pytest.mark.parametrize("wish", [Command(0.0, -0.5), Command(-0.2, 0.0)])
def test_turning_on_the_spot_and_backing_up_are_left_alone(wish):
    """Only going ahead is slowed."""
    assert slowed(wall_ahead(0.1), wish, 0.2) == wish
