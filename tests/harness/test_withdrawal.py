"""People who leave stay in the record: what they drove, when they left and why."""

from dataclasses import replace

import pytest

from harness.plan import Plan
from harness.session import Session
from harness.world import BulletWorld
from protocols.cohort import Cohort
from protocols.load import resolve_study


@pytest.fixture(scope="module")
def record():
    """Return the session of somebody with hardly any patience."""
    study = resolve_study("four-lap")
    cohort = Cohort.model_validate({"traits": {"patience_s": {"median": 10.5, "spread": 0}}})
    protocol = study.protocol.model_copy(update={"cohort": cohort})
    world = BulletWorld(study.course, protocol.laser, protocol.control_period_s)
    return Session(Plan(replace(study, protocol=protocol), 0), 1, world).run()


def test_the_lap_ends_with_a_reason(record):
    """The lap is kept as far as it went; it has a duration and no lap time."""
    last = record.laps[-1]
    assert last.row.end_reason == "withdrew"
    assert last.row.withdrawal == "this takes too long"
    assert last.row.lap_time_s is None
    assert last.row.duration_s > 10.5
    assert last.steps.num_rows == round(last.row.duration_s / 0.1)


def test_the_session_ends_and_the_person_stays_counted(record):
    """Nothing is driven or asked afterwards, and the participant's row says so."""
    person = record.participant
    assert person.laps_planned == 5
    assert person.laps_driven == len(record.laps) < 5
    assert not person.completed
    assert all(answer.lap < record.laps[-1].row.lap for answer in record.answers)


def test_too_few_laps_exclude_with_the_rule_that_says_so(record):
    """Whoever finished no lap that counts is excluded by the protocol's own rule, in words."""
    finished = [lap for lap in record.laps if lap.row.completed and not lap.row.practice]
    assert record.participant.excluded == (not finished)
    if not finished:
        assert "completed 0 laps" in record.participant.exclusion_reason
