"""The courses beside the default one are what they say, and can be driven."""

import itertools
import math

import numpy as np
import pytest

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from harness.world.laser import Laser
from protocols.course.centreline import Centreline
from protocols.course.obstacles import floor_plan, obstacle_boxes
from protocols.load import load_course
from protocols.pose import Pose
from protocols.resolved import ResolvedStudy
from protocols.study import StudyProtocol
from protocols.wheelchair import LASER_AHEAD


def _turns(course, kinds):
    """Return the heading's change over the sections of some kinds, degrees, by name."""
    line = Centreline(course)
    arcs = {s.name: np.linspace(s.start - 0.01, s.end + 0.01, 200)
            for s in line.sections if s.kind in kinds}  # fmt: skip
    headings = {n: np.unwrap([line.point(a).heading for a in at]) for n, at in arcs.items()}
    return {name: math.degrees(h[-1] - h[0]) for name, h in headings.items()}


def test_the_mirror_image_is_one():
    """Every obstacle of the default course stands in the mirror image, its y turned around."""
    run = floor_plan(load_course("lab-office"))
    mirror = load_course("lab-office-mirror")
    original = obstacle_boxes(load_course("lab-office"))
    for ours, theirs in zip(obstacle_boxes(mirror), original, strict=True):
        flipped = [(x, -y) for x, y in ours.corners()]
        for corner in theirs.corners():
            assert min(math.dist(corner, other) for other in flipped) < 1e-9
    assert floor_plan(mirror).area == pytest.approx(run.area, abs=1e-6)


def test_the_mirror_image_has_no_right_turn():
    """All four corners are left turns, two of them sharp: nothing there for the limitation."""
    mirror = load_course("lab-office-mirror")
    assert {s.kind for s in mirror.sections} == {"straight", "left"}
    turns = _turns(mirror, {"left"})
    assert all(turn > 30 for turn in turns.values())
    assert min(turns["L1"], turns["L2"]) > 100


def test_the_ward_has_every_kind_of_turn():
    """Sharp rights over 60 degrees, soft rights below, and left turns over 60 degrees."""
    ward = load_course("ward-corridor")
    sharp = _turns(ward, {"sharp_right"})
    soft, left = _turns(ward, {"soft_right"}), _turns(ward, {"left"})
    assert len(sharp) == len(soft) == len(left) == 2
    assert all(turn < -60 for turn in sharp.values())
    assert all(-60 < turn < -20 for turn in soft.values())
    assert all(turn > 60 for turn in left.values())


def _view(course, arc):
    """Return the laser's segments from a place on the centreline."""
    x, y, heading = Centreline(course).point(arc)
    ahead = Pose(x + LASER_AHEAD * math.cos(heading), y + LASER_AHEAD * math.sin(heading), heading)
    return Laser(obstacle_boxes(course), 180).scan(ahead, np.random.default_rng(0))[1]


def test_lidar_tells_the_wards_turns_apart():
    """Coming to turns of different kinds, the 15 segments differ by a lengthscale (2 m) in all."""
    ward = load_course("ward-corridor")
    turns = [s for s in Centreline(ward).sections if s.kind != "straight"]
    views = {s.name: [_view(ward, s.start - back) for back in (0.1, 0.3, 0.5)] for s in turns}
    kinds = {s.name: s.kind for s in turns}
    for one, two in itertools.combinations(views, 2):
        nearest = min(np.linalg.norm(a - b) for a in views[one] for b in views[two])
        assert nearest > 2.0 or kinds[one] == kinds[two], (one, two, nearest)


@pytest.mark.parametrize("driver", ["autonomous", "human"])
@pytest.mark.parametrize("name", ["lab-office-mirror", "ward-corridor"])
def test_both_kinds_of_driver_finish_a_lap(name, driver):
    """Without limitation or help they reach the finish through every gate, touching nothing."""
    protocol = StudyProtocol.model_validate(
        {"name": "lap", "title": "A lap", "course": name, "conditions": {"baseline": {}},
         "cohort": {"participants": 1, "driver": {"use": driver}},
         "laps": [{"condition": "baseline", "time_limit_s": 90}]}
    )  # fmt: skip
    study = ResolvedStudy(protocol, load_course(name), ())
    world = BulletWorld(study.course, laser=protocol.laser, period=protocol.control_period_s,
                        start_noise=protocol.start_noise)  # fmt: skip
    run = StudyRun(study, 0)
    (lap,) = Session(run, 1, world, make_parts(run, 1)).run().laps
    assert lap.row.completed
    assert lap.row.collisions == 0
