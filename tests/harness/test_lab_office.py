"""The default course has the paper's layout, and lidar can tell its corners apart."""

import itertools
import math

import numpy as np

from harness.world.laser import Laser
from protocols.course.centreline import Centreline
from protocols.course.obstacles import obstacle_boxes
from protocols.load import load_course
from protocols.pose import Pose
from protocols.wheelchair import LASER_AHEAD

COURSE = load_course("lab-office")
LINE = Centreline(COURSE)


def _turn(section):
    """Return the heading's change over a section, degrees, left positive."""
    # Vertices at a turn's ends belong to the turn.
    pad = 0.01 if "right" in section.kind else -0.01
    arcs = np.linspace(section.start - pad, section.end + pad, 200)
    headings = np.unwrap([LINE.point(arc).heading for arc in arcs])
    return math.degrees(headings[-1] - headings[0])


def test_sharp_and_soft_turns_are_where_the_paper_has_them():
    """R1 and R2 are well over 60 degrees to the right; on the way back bends are below 60."""
    kinds = [(s.name, s.kind) for s in LINE.sections]
    assert [name for name, kind in kinds if kind == "sharp_right"] == ["R1", "R2"]
    for section in LINE.sections:
        turn = _turn(section)
        if section.kind == "sharp_right":
            assert turn < -100
        elif section.kind == "soft_right":
            assert -60 < turn < -20
        else:
            assert abs(turn) < 1
    second = next(s for s in LINE.sections if s.name == "R2")
    soft = [s for s in LINE.sections if s.kind == "soft_right"]
    assert soft
    assert all(s.start >= second.end for s in soft)


def test_the_lap_is_a_loop_of_the_papers_size():
    """F lies behind S, and the lap is short enough for the autonomous driver's 34.6 s."""
    end = LINE.point(LINE.length)
    assert math.dist(end[:2], (COURSE.start.x, COURSE.start.y)) < 1.0
    assert 15.0 < LINE.length < 24.2
    assert [gate.name for gate in COURSE.gates] == ["R1", "R2", "F"]


def test_gates_stand_in_their_corners():
    """R1 and R2 are crossed in the sections of their names."""
    for gate in COURSE.gates[:2]:
        middle = np.mean([gate.left, gate.right], axis=0)
        arc, _ = LINE.locate(*middle)
        assert LINE.section(arc).name == gate.name


def _view(arc, offset=0.0):
    """Return the laser's segments from a place on the centreline, without noise worth mention."""
    x, y, heading = LINE.point(arc)
    x, y = x - offset * math.sin(heading), y + offset * math.cos(heading)
    sensor = Pose(x + LASER_AHEAD * math.cos(heading), y + LASER_AHEAD * math.sin(heading), heading)
    return Laser(obstacle_boxes(COURSE), 180).scan(sensor, np.random.default_rng(0))[1]


def test_lidar_tells_sharp_corners_from_soft_bends():
    """Coming to a turn, the 15 segments differ between all turns, more than along one approach.

    Apart by 2 m in all is one lengthscale of the model (Table I).
    """
    turns = [s for s in LINE.sections if "right" in s.kind]
    views = {s.name: [_view(s.start - back) for back in (0.1, 0.3, 0.5)] for s in turns}
    for one, two in itertools.combinations(views, 2):
        nearest = min(np.linalg.norm(a - b) for a in views[one] for b in views[two])
        sharp = {one, two} & {"R1", "R2"}
        assert nearest > (2.0 if sharp else 0.5), (one, two, nearest)
