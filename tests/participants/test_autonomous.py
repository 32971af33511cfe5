"""The autonomous driver drives laps: quick without the limitation, slow with it, unharmed."""

import numpy as np
import pytest

from lad.command import Command
from participants.registry import make_driver
from participants.setup import DriverSetup
from participants.sight import Sight
from protocols.files.errors import InputError
from protocols.pose import Pose
from protocols.wheelchair import LASER_AHEAD

BEARINGS = np.radians(np.linspace(-120.0, 120.0, 180))


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


def test_control_noise_makes_commands_inexact(lab_office, room):
    """Commands scatter by the share the protocol says, and never leave what the chair can do."""
    room.pose = Pose(1.0, 0.0, 0.0)
    sight = Sight(
        t=0.0, pose=room.pose, velocity=Command(0.4, 0.0), ranges=room.scan(), bearings=BEARINGS,
        laser=LASER_AHEAD, gates_passed=0, helped=False,
    )  # fmt: skip
    commands = {}
    for noise in (0.0, 0.05):
        setup = DriverSetup(lab_office, np.random.default_rng(0), options={"control_noise": noise})
        rd = make_driver("autonomous", setup)
        rows = []
        for seed in range(200):
            rd.start_lap(0, np.random.default_rng(seed))
            rows.append(rd.act(sight))
        commands[noise] = np.array(rows)
    inside = np.abs(commands[0.05][:, 0]) < 0.7
    ratio = commands[0.05][inside, 0] / commands[0.0][inside, 0]
    assert ratio.std() == pytest.approx(0.05, rel=0.2)
    assert (np.abs(commands[0.05]) <= (0.7, 0.5)).all()


def test_options_are_checked(lab_office):
    """A misspelt option is an error, not silence."""
    setup = DriverSetup(lab_office, np.random.default_rng(0), options={"speed": 1})
    with pytest.raises(InputError, match="'speed' does not exist; allowed: control_noise"):
        make_driver("autonomous", setup)
