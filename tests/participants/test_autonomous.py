"""The autonomous driver drives laps: quick without the limitation, slow with it, unharmed."""

import numpy as np
import pytest

from participants.registry import make_driver
from participants.setup import DriverSetup
from protocols.errors import InputError
from protocols.pose import Pose


@pytest.fixture
def driver(lab_office):
    """Return an autonomous driver of the default course."""
    rd = make_driver("autonomous", DriverSetup(lab_office, np.random.default_rng(0)))
    rd.start_lap(0, np.random.default_rng(1))
    return rd


def test_a_free_lap(driver, room):
    """About half a minute, nothing touched, never faster than the chair."""
    lap = room.lap(driver)
    assert lap.finished
    assert lap.contacts == 0
    assert 25.0 < lap.time < 45.0
    assert lap.column("user_v").max() <= 0.7
    assert np.abs(lap.column("user_w")).max() <= 0.5


def test_a_limited_lap_takes_far_longer(driver, room, limitation):
    """The limitation nearly doubles the lap time (the paper: 34.6 to 59.1 s)."""
    lap = room.lap(driver, limitation=limitation)
    assert lap.finished
    assert lap.contacts == 0
    assert 50.0 < lap.time < 75.0


def test_it_turns_sharply_at_the_corners(driver, room):
    """At R1 and R2 it turns right at full rate."""
    lap = room.lap(driver)
    for corner in (s for s in room.line.sections if s.kind == "sharp_right"):
        inside = (lap.column("arc") >= corner.start) & (lap.column("arc") <= corner.end)
        assert lap.column("w")[inside].min() < -0.45


def test_a_lap_is_its_random_numbers(driver, room):
    """The same localisation errors make the same lap; others make another, about as long."""
    laps = []
    for seed in (2, 2, 3):
        driver.start_lap(1, np.random.default_rng(seed))
        laps.append(room.lap(driver))
    assert laps[0].rows == laps[1].rows
    assert laps[0].rows != laps[2].rows
    assert laps[0].time == pytest.approx(laps[2].time, abs=2.0)


def test_it_gets_free_from_a_bad_place(driver, room, limitation):
    """Facing backwards with its nose at an obstacle, limited, it still finishes."""
    lap = room.lap(driver, limitation=limitation, pose=Pose(0.14, -0.2, -2.2))
    assert lap.finished


def test_it_takes_no_options(lab_office):
    """A misspelt option is an error, not silence."""
    setup = DriverSetup(lab_office, np.random.default_rng(0), options={"speed": 1})
    with pytest.raises(InputError, match="'speed' does not exist; allowed: it takes no options"):
        make_driver("autonomous", setup)
