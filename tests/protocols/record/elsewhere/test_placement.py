"""Positions are held against the course."""

import numpy as np
import pytest

from protocols.course.centreline import Centreline
from protocols.load import load_course
from protocols.record.elsewhere.placement import Floor, said_of


@pytest.fixture(scope="module")
def course():
    """Return the shipped course."""
    return load_course("lab-office")


@pytest.fixture(scope="module")
def floor(course):
    """Return where the chair can be on it."""
    return Floor(course)


@pytest.fixture(scope="module")
def way(course):
    """Return a lap along the centreline, a step short of its end."""
    line = Centreline(course)
    poses = [line.point(arc) for arc in np.arange(0, line.length - 0.05, 0.1)]
    return np.array([(pose.x, pose.y) for pose in poses])


def test_a_lap_on_the_course_is_on_it(floor, way):
    """The last step begins before the last gate: the lap is whole."""
    placement = floor.placement(way, finished=True)
    assert placement.on_course
    assert placement.whole


def _turned(way, degrees):
    turn = np.deg2rad(degrees)
    c, s = np.cos(turn), np.sin(turn)
    return way @ np.array([[c, s], [-s, c]])


@pytest.mark.parametrize(
    ("change", "likely", "metres"),
    [
        (lambda w: 1000 * w, "millimetres", False),
        (lambda w: 100 * w, "centimetres", False),
        (lambda w: w * [1, -1], "y mirrored", True),
        (lambda w: w[:, ::-1], "x and y exchanged", True),
        (lambda w: w + np.array([12.0, -3.5]), "moved by (-12.0, 3.5) m", True),
        (lambda w: _turned(w, 90) - [5.0, 0.0], "turned by -90 degrees, moved by", True),
        (lambda w: 1000 * (w - 20), "millimetres, moved by", False),
        (lambda w: w / [7e4, 1.1e5] + [11.5, 48.1], "latitude and longitude", False),
        (lambda w: _turned(w, 17) * 3 + 50, "", False),
    ],
)
def test_another_frame_is_named(floor, way, change, likely, metres):
    """What the positions are not, and what they may be; distances only in metres."""
    placement = floor.placement(change(way), finished=True)
    assert not placement.on_course
    assert placement.likely.startswith(likely)
    assert bool(placement.likely) == bool(likely)
    assert placement.metres is metres


def test_a_part_of_a_lap_is_no_other_frame(floor, way):
    """On the floor, and short of the last gate: the positions are right, the lap is not whole."""
    placement = floor.placement(way[: len(way) // 3], finished=True)
    assert placement.on_course
    assert not placement.whole
    assert floor.placement(way[: len(way) // 3], finished=False).whole


def test_a_few_errors_of_a_sensor_are_no_other_frame(floor, way):
    """Two positions of a lap far outside."""
    astray = way.copy()
    astray[[20, 60]] = 500.0
    assert floor.placement(astray, finished=False).on_course


def test_a_trembling_sensor_is_no_other_frame(floor, way):
    """Positions that err by more than the chair moves: the lap ends where it ends, all the same."""
    fine = np.array(
        [np.interp(np.linspace(0, len(way) - 1, 1000), range(len(way)), a) for a in way.T]
    )
    for seed in range(20):
        errors = np.random.default_rng(seed).normal(0, 0.03, (1000, 2))
        placement = floor.placement(fine.T + errors, finished=True)
        assert placement.on_course
        assert placement.whole


def test_a_place_as_near_as_sensors_go_is_no_other_frame(floor, way):
    """Wherever the record ends, and the first position 9 cm behind the start: nothing was moved."""
    onwards = (way[-1] - way[-6]) / np.hypot(*(way[-1] - way[-6]))
    for end in np.arange(0.3, 0.7, 0.02):
        short = np.vstack([way[:-10], way[-1] - end * onwards]) - 0.09 * onwards
        assert floor.placement(short, finished=True).likely == ""


def test_unknown_positions_are_nowhere(floor):
    """Nothing recorded: nothing to say."""
    assert floor.placement(np.full((5, 2), np.nan), finished=True).on_course


def test_laps_with_one_guess_are_said_once(floor, way):
    """A hundred laps of one wrong frame are a line, whatever each was moved by."""
    moved = [floor.placement(way + np.array([30.0 + n, 0.0]), finished=True) for n in range(3)]
    (said,) = said_of(moved)
    assert "positions of 3 laps do not fit the course (100% of the steps" in said
    assert "no map is drawn from them" in said
