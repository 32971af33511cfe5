"""People who leave stay in the record: what they drove, when they left and why."""

from dataclasses import replace

import pytest

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from protocols.cohort import Cohort
from protocols.declared import Exclusion
from protocols.exclusion import exclusion_reason
from protocols.load import resolve_study


@pytest.fixture(scope="module")
def record():
    """Return the session of a person with hardly any patience."""
    study = resolve_study("four-lap")
    cohort = Cohort.model_validate({"traits": {"patience_s": {"median": 10.5, "spread": 0}}})
    protocol = study.protocol.model_copy(update={"cohort": cohort})
    world = BulletWorld(study.course, protocol.laser, protocol.control_period_s)
    run = StudyRun(replace(study, protocol=protocol), 0)
    return Session(run, 1, world, make_parts(run, 1)).run()


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


def test_a_participant_who_leaves_is_not_excluded(record):
    """The shipped study has no rule that would take dropouts out of its denominators."""
    assert not record.participant.excluded
    assert record.participant.exclusion_reason is None


def test_too_few_laps_exclude_with_the_rule_that_says_so(record):
    """Where a protocol has the rule, it excludes in words."""
    finished = sum(lap.row.completed and not lap.row.practice for lap in record.laps)
    rule = Exclusion(min_completed_laps=finished + 1)
    said = exclusion_reason(rule, [lap.row for lap in record.laps])
    assert said == f"completed {finished} laps; the protocol asks for {finished + 1}"
