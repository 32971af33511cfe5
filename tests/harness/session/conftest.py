"""A short study with every kind of stage, and a world without a physics engine."""

import json

import numpy as np
import pytest

from harness.session.study_run import StudyRun
from harness.world.world import Observation
from lad.command import STILL, Command
from lad.inputs import N_SEGMENTS
from protocols.load import load_course, resolve_study
from protocols.pose import Pose

LIMITED = {"limitation": {"right_turn_rad_s": 0.15}}

EVERY_STAGE = {
    "schema": 1,
    "name": "every stage",
    "title": "Every kind of stage",
    "cohort": {"participants": 2, "driver": {"use": "autonomous"}},
    "conditions": {
        "limited": LIMITED,
        "shown": {**LIMITED, "assistant": "demonstrator", "training": True},
        "helped": {**LIMITED, "assistant": "model"},
    },
    "consent": {"text": "Do you agree?", "version": "1"},
    "demographics": ["age_years", "handedness"],
    "laps": [
        {"condition": "limited", "practice": True, "time_limit_s": 2, "break_s": 5},
        {"condition": "shown", "time_limit_s": 10},
        {
            "condition": "helped",
            "time_limit_s": 3,
            "survey": [{"instrument": "driving-assistance", "items": "all"}],
        },
    ],
    "debrief": {"text": "Thank you."},
}


class ToyWorld:
    """A world without walls or physics: the chair does at once what it is told."""

    period = 0.1
    bearings = np.linspace(-2, 2, 21)
    laser_offset = 0.5

    def __init__(self, course):
        self.start = Pose(course.start.x, course.start.y, course.start.heading)
        self.told = []
        self.reset(np.random.default_rng(0))

    def reset(self, rng):
        self.rng, self.pose, self.velocity, self.n = rng, self.start, STILL, 0
        self.ranges = np.full(21, 4.0)

    def observe(self):
        return Observation(
            t=self.n * self.period,
            pose=self.pose,
            velocity=self.velocity,
            ranges=self.ranges,
            segments=np.full(N_SEGMENTS, self.ranges.min()),
            clearance_m=1.0,
            contact=False,
        )

    def safeguard(self, command):
        return Command(min(command.v, 0.6), command.w)

    def step(self, command):
        self.told.append(command)
        x, y, heading = self.pose
        heading += command.w * self.period
        way = command.v * self.period
        self.pose = Pose(x + way * np.cos(heading), y + way * np.sin(heading), heading)
        self.velocity = command
        self.ranges = 3.9 + 0.05 * self.rng.random(21)
        self.n += 1


@pytest.fixture
def study_of(tmp_path):
    """Return a function that makes a run of a protocol given as data."""

    def make(data, seed=5):
        path = tmp_path / "protocol.yaml"
        path.write_text(json.dumps(data))
        return StudyRun(resolve_study(str(path)), seed)

    return make


@pytest.fixture
def every_stage(study_of):
    """Return a study with every kind of stage."""
    return study_of(EVERY_STAGE)


@pytest.fixture
def toy_world():
    """Return a world on the default course that needs no physics engine."""
    return ToyWorld(load_course("lab-office"))
