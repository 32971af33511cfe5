"""A lap's steps are written down, and the lap is summed up from its own record."""

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness.session.lap import Ending, Step
from harness.session.lap_log import LapLog, summary
from harness.world.world import Observation
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import STILL, Command
from protocols.course.centreline import Centreline
from protocols.load import load_course
from protocols.pose import Pose

HELP = Assistance(helping=True, command=Command(0.2, -0.5))
GUESS = Assistance(helping=False, p_help=0.25, mean=Command(0.1, -0.4), variance=0.02)


def seen(x, y, contact=False):
    """Return what a world shows at a place."""
    return Observation(
        t=0.0,
        pose=Pose(x, y, 0.0),
        velocity=Command(0.3, 0.0),
        ranges=np.full(21, 4.0),
        segments=np.full(15, 4.0),
        clearance_m=0.4,
        contact=contact,
    )


def step(**changes):
    """Return a step in which nothing special happens, but for the changes."""
    course = load_course("lab-office")
    here = seen(course.start.x, course.start.y)
    usual = {
        "seen": here,
        "x": np.arange(19.0),
        "intent": Command(0.7, -0.5),
        "demonstrator": NO_ASSISTANCE,
        "model": GUESS,
        "control": "driver",
        "arbitrated": Command(0.7, -0.15),
        "executed": Command(0.7, -0.15),
        "result": here,
        "input_age_s": 0.0,
        "timing": None,
    }
    return Step(**{**usual, **changes})


def ending(reason, t, gates, note=None):
    """Return how a lap ended."""
    return Ending(reason, t, gates, note, seen(1.0, 2.0))


@pytest.fixture
def written():
    """Write steps down and return them as rows."""

    def write(*steps, demonstrated=False):
        log = LapLog(Centreline(load_course("lab-office")), demonstrated=demonstrated)
        for one in steps:
            log.record(one)
        return log.table().to_pylist()

    return write


def test_a_shadow_states_what_it_would_do_and_claims_nothing(written):
    """In laps the demonstrator does not drive, h and a are missing; h_would and would are not."""
    row = written(step(demonstrator=HELP))[0]
    assert (row["h"], row["a_v"], row["a_w"]) == (None, None, None)
    assert (row["h_would"], row["would_v"], row["would_w"]) == (1, 0.2, -0.5)


def test_a_demonstration_records_signal_and_command(written):
    """Where the demonstrator drives, h is -1 or +1, and a is there where h is +1."""
    helping, watching = written(step(demonstrator=HELP), step(), demonstrated=True)
    assert (helping["h"], helping["a_v"], helping["a_w"]) == (1, 0.2, -0.5)
    assert (watching["h"], watching["a_v"]) == (-1, None)


def test_the_model_is_recorded_while_it_only_watches(written):
    """p(h), mean and variance are in every step, with any driver."""
    row = written(step())[0]
    assert (row["p_help"], row["mean_v"], row["mean_w"], row["variance"]) == (0.25, 0.1, -0.4, 0.02)


def test_the_inputs_are_recorded_as_the_model_saw_them(written):
    """The 19 inputs come out in the order they went in."""
    row = written(step())[0]
    assert [row["user_v"], row["velocity_w"], row["segment_14"]] == [0.0, 3.0, 18.0]


def test_contact_belongs_to_the_step_in_which_it_happened(written):
    """A touch during a step is in that step's row, and so is what the guard changed."""
    row = written(step(result=seen(0, 0, contact=True), executed=STILL))[0]
    assert row["contact"]
    assert row["safeguarded"]


def lap_of(control, contact):
    """Return a step table with these two columns."""
    return pa.table({"control": control, "contact": pa.array(contact, pa.bool_())})


def test_stretches_are_counted_once():
    """Two unbroken stretches of help are two interventions, however long each is."""
    control = ["driver", "model", "model", "driver", "model"]
    row = summary(
        lap_of(control, [True, True, False, False, True]), ending("finished", 0.46, 3), 0.1
    )
    assert (row["interventions"], row["collisions"]) == (2, 2)
    assert row["assisted_fraction"] == pytest.approx(0.6)
    assert row["contact_time_s"] == pytest.approx(0.3)
    assert (row["lap_time_s"], row["completed"]) == (0.46, True)


@pytest.mark.parametrize("reason", ["time_limit", "withdrew"])
def test_an_unfinished_lap_has_no_lap_time(reason):
    """How long an unfinished lap took is its duration, never its lap time."""
    row = summary(lap_of(["driver"], [False]), ending(reason, 7.0, 1, "no"), 0.1)
    assert (row["lap_time_s"], row["duration_s"], row["completed"]) == (None, 7.0, False)
    assert row["end_reason"] == reason


@given(st.lists(st.booleans(), max_size=40))
def test_stretches_agree_with_counting_by_hand(contact):
    """The number of contacts is the number of times a step touches and the one before did not."""
    by_hand = sum(
        now and not before
        for before, now in zip([False, *contact][: len(contact)], contact, strict=True)
    )
    row = summary(lap_of(["driver"] * len(contact), contact), ending("time_limit", 1.0, 0), 0.1)
    assert row["collisions"] == by_hand
