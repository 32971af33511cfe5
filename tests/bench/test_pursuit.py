"""The control every simulator gets."""

import math

import pytest
from pursuit import Pursuit
from synthetic_course import synthetic_course

from protocols.course.centreline import Centreline
from protocols.pose import Pose
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE


def _driven(seconds: float, rate_hz: int, start: Pose) -> tuple[list[Pose], float]:
    """Drive an ideal chair; return its poses and the greatest turning rate asked for."""
    pursuit, pose, poses, sharpest = Pursuit(synthetic_course(20)), start, [start], 0.0
    for _ in range(round(seconds * rate_hz)):
        command = pursuit.act(pose)
        heading = pose.heading + command.w / rate_hz / 2
        pose = Pose(
            pose.x + command.v / rate_hz * math.cos(heading),
            pose.y + command.v / rate_hz * math.sin(heading),
            pose.heading + command.w / rate_hz,
        )
        poses.append(pose)
        sharpest = max(sharpest, abs(command.w))
        assert command.v == MAX_SPEED
    return poses, sharpest


@pytest.mark.parametrize("rate_hz", [10, 20])
def test_it_stays_on_the_path_lap_after_lap(rate_hz: int) -> None:
    """Two rounds and more keep within 15 cm of the closed path, inside the chair's turning rate."""
    course = synthetic_course(20)
    line, start = Centreline(course), course.start
    poses, sharpest = _driven(90.0, rate_hz, Pose(start.x, start.y, start.heading))
    assert sharpest <= MAX_TURN_RATE
    assert max(abs(line.locate(x, y)[1]) for x, y, _ in poses if x < 5.4 or x > 6.1) < 0.15
    assert poses[-1].heading == pytest.approx(90.0 * MAX_SPEED / 27.8 * math.tau, rel=0.1)


def test_it_finds_back_to_the_path() -> None:
    """A chair that starts half a metre beside the path is on it five metres on."""
    course = synthetic_course(20)
    poses, _ = _driven(7.0, 20, Pose(course.start.x, course.start.y + 0.5, 0.3))
    assert abs(Centreline(course).locate(*poses[-1][:2])[1]) < 0.1
