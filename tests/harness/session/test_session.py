"""A session: planned laps in their order, what is asked after them, and what is kept."""

import json
from dataclasses import replace

import numpy as np
import pytest

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from lad.lad_assistant import LADAssistant
from participants.driver import WithdrewError
from protocols.load import load_course, resolve_study

SHORT = {
    "schema": 1,
    "name": "short",
    "title": "Six seconds of each",
    "cohort": {"participants": 2, "driver": {"use": "autonomous"}},
    "conditions": {
        "limited": {"limitation": {"right_turn_rad_s": 0.15}},
        "shown": {
            "limitation": {"right_turn_rad_s": 0.15},
            "assistant": "demonstrator",
            "training": True,
        },
        "helped": {"limitation": {"right_turn_rad_s": 0.15}, "assistant": "model"},
    },
    "laps": [
        {"condition": "limited", "practice": True, "time_limit_s": 2},
        {"condition": "limited", "time_limit_s": 12},
        {"condition": "shown", "time_limit_s": 12},
        {
            "condition": "helped",
            "time_limit_s": 12,
            "survey": [{"instrument": "driving-assistance", "items": "all"}],
        },
    ],
}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return a short study of every kind of lap."""
    path = tmp_path_factory.mktemp("protocol") / "short.yaml"
    path.write_text(json.dumps(SHORT))
    return StudyRun(resolve_study(str(path)), 5)


@pytest.fixture(scope="module")
def world():
    """Return a world with the default course."""
    return BulletWorld(load_course("lab-office"))


@pytest.fixture(scope="module")
def record(run, world):
    """Return the first participant's session."""
    return Session(run, 1, world, make_parts(run, 1)).run()


def test_every_planned_lap_is_driven_in_order(record):
    """The runner executes what the file says, practice laps included."""
    assert [(r.row.lap, r.row.condition, r.row.practice) for r in record.laps] == [
        (0, "limited", True),
        (1, "limited", False),
        (2, "shown", False),
        (3, "helped", False),
    ]
    assert [r.row.end_reason for r in record.laps] == ["time_limit"] * 4
    assert record.participant.laps_driven == 4
    assert not record.participant.completed


def test_the_model_learns_in_the_training_lap_only(record):
    """Basis vectors appear in the training lap and stay as they are afterwards."""
    when = [r.row.basis_vectors_when for r in record.laps]
    how = [r.row.basis_vectors_how for r in record.laps]
    assert when[:2] == how[:2] == [0, 0]
    assert when[2] > 50
    assert how[2] > 5
    assert (when[3], how[3]) == (when[2], how[2])
    assert LADAssistant.from_bytes(record.model).when.n_basis == when[3]


def test_predictions_are_out_of_sample(record):
    """The first step of training is predicted by a model that has learnt nothing."""
    p = record.laps[2].steps["p_help"].to_numpy()
    assert p[0] == 0.5
    assert p[1] != 0.5


def test_the_limitation_is_what_the_protocol_says(record):
    """Commanded right turns reach the model, and the chair, scaled by 0.15/0.5."""
    for lap in record.laps[:2]:
        intent, user = lap.steps["intent_w"].to_numpy(), lap.steps["user_w"].to_numpy()
        expected = np.where(intent < 0, 0.3 * intent, intent)
        np.testing.assert_allclose(user, expected, atol=1e-12)
        assert (intent < -0.1).any() or lap.row.practice


def test_a_takeover_puts_the_demonstrators_command_through(record):
    """While the demonstrator helps, its command is the one after arbitration."""
    steps = record.laps[2].steps.to_pandas()
    helped = steps[steps.control == "demonstrator"]
    assert len(helped) > 5
    assert (helped.h == 1).all()
    np.testing.assert_array_equal(helped.arbitrated_w, helped.a_w)


def test_what_is_planned_is_asked(record):
    """Every item planned after a lap has a row, answered or not."""
    assert [a.item for a in record.answers] == [f"Q{i}" for i in range(1, 12)]
    assert {a.lap for a in record.answers} == {3}
    assert all(a.response is None or 1 <= a.response <= 5 for a in record.answers)


def test_sessions_do_not_depend_on_what_the_world_did_before(run, world, record):
    """Another participant in between changes nothing: the same session again is the same."""
    other = Session(run, 2, world, make_parts(run, 2)).run()
    again = Session(run, 1, world, make_parts(run, 1)).run()
    assert other.laps[1].steps != record.laps[1].steps
    assert again == record


class LeavesInTheSecondLap:
    """A driver who has had enough after one lap and a second."""

    def __init__(self, driver):
        self.driver, self.lap = driver, 0

    def start_lap(self, lap, rng):
        self.lap = lap
        self.driver.start_lap(lap, rng)

    def act(self, sight):
        if self.lap == 1 and sight.t > 1:
            raise WithdrewError("too slow for me")
        return self.driver.act(sight)


def test_a_withdrawal_ends_the_session_and_keeps_what_was(run, world):
    """Who leaves in the second lap has two laps on record, with the reason, and no answers."""
    parts = make_parts(run, 1)
    driver = LeavesInTheSecondLap(parts.lap.driver)
    session = Session(run, 1, world, replace(parts, lap=replace(parts.lap, driver=driver)))
    record = session.run()
    assert [r.row.end_reason for r in record.laps] == ["time_limit", "withdrew"]
    assert record.laps[1].row.withdrawal == "too slow for me"
    assert record.laps[1].row.lap_time_s is None
    assert (record.participant.laps_planned, record.participant.laps_driven) == (4, 2)
    assert record.answers == ()
