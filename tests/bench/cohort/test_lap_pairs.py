"""The cheap laps of the calibration are the study's own."""

from dataclasses import replace

import pytest
from cohort.lap_pairs import PairTrack, drive_all, patient, person_traits

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from protocols.cohort import Cohort
from protocols.load import resolve_study

SEED, NUMBER = 3, 2


@pytest.fixture(scope="module")
def session():
    """Return the first three laps of a participant of the shipped study."""
    study = resolve_study("four-lap")
    protocol = study.protocol.model_copy(update={"laps": study.protocol.laps[:3]})
    world = BulletWorld(study.course, protocol.laser, protocol.control_period_s)
    run = StudyRun(replace(study, protocol=protocol), SEED)
    return Session(run, NUMBER, world, make_parts(run, NUMBER)).run()


@pytest.fixture(scope="module")
def traits():
    """Return that participant's traits."""
    return person_traits(Cohort(), SEED, NUMBER)


def test_the_laps_are_those_of_the_study(session, traits):
    """With the familiarisation lap before them, to the last digit: who watches touches nothing."""
    pair = PairTrack(SEED, familiarised=True).drive(NUMBER, traits)
    assert [pair.baseline_s, pair.limited_s] == [lap.row.lap_time_s for lap in session.laps[1:]]


def test_the_familiarisation_lap_hardly_matters(session, traits):
    """Left out, lap times move by less than a second."""
    pair = PairTrack(SEED).drive(NUMBER, traits)
    times = [lap.row.lap_time_s for lap in session.laps[1:]]
    assert [pair.baseline_s, pair.limited_s] == pytest.approx(times, abs=1.0)


def test_an_unfinished_lap_is_called_so(traits):
    """Who does not get there within the limit has not driven a lap."""
    (pair,) = drive_all([(NUMBER, patient(traits))], SEED, time_limit=5.0)
    assert [pair.baseline_done, pair.limited_done] == [False, False]
    assert pair.baseline_s == pytest.approx(5.0)
