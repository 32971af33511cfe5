"""Whole laps by human-like drivers: all finish, and no two drive alike."""

import numpy as np
import pytest

from participants.attentive import AttentiveDemonstrator, AttentiveOptions
from participants.cohort import draw_person
from participants.registry import make_driver
from participants.setup import DriverSetup
from protocols.cohort import Cohort
from protocols.pose import Pose

PEOPLE = 6


def person(lab_office, i):
    """Return the i-th person of a cohort in the chair."""
    traits = draw_person(Cohort(), np.random.default_rng([7, i])).traits
    return make_driver("human", DriverSetup(lab_office, np.random.default_rng(i), traits=traits))


@pytest.fixture(scope="module")
def sessions(lab_office, room, limitation):
    """Drive baseline, limited, demonstrator-assisted and limited laps of six people."""
    found = []
    for i in range(PEOPLE):
        driver = person(lab_office, i)
        helper = AttentiveDemonstrator(lab_office, AttentiveOptions(), np.random.default_rng(i))
        laps = []
        for lap, rules in enumerate(
            (
                {},
                {"limitation": limitation},
                {"limitation": limitation, "helper": helper},
                {"limitation": limitation},
            ),
            start=1,
        ):
            driver.start_lap(lap, np.random.default_rng([9, i, lap]))
            laps.append(room.lap(driver, **rules))
        found.append(laps)
    return found


def test_everybody_finishes_unharmed(sessions):
    """No lap ends unfinished, and contacts are rare."""
    laps = [lap for session in sessions for lap in session]
    assert all(lap.finished for lap in laps)
    assert sum(lap.contacts for lap in laps) <= 2


def test_the_limited_lap_is_the_slowest_for_nearly_all(sessions):
    """The limitation costs time, and the demonstrator gives most of it back."""
    times = np.array([[lap.time for lap in session[:3]] for session in sessions])
    baseline, limited, helped = times.T
    assert (limited > baseline).sum() >= PEOPLE - 1
    assert (limited > helped).all()
    assert limited.mean() > baseline.mean() + 10.0
    assert limited.mean() > helped.mean() + 10.0


def test_people_differ_more_than_their_own_laps(sessions):
    """Two limited laps of one person are alike; those of two persons are not."""
    two = np.array([[session[1].time, session[3].time] for session in sessions])
    within = np.abs(two[:, 0] - two[:, 1]).mean()
    assert two.mean(axis=1).std() > 2 * within


def test_commands_at_the_sharp_corners_are_repeatable(sessions, room):
    """From lap to lap a person's command in the same place differs by less than 0.1.

    That is the model's lengthscale for the user's command (Table I).
    """
    differences = []
    for session in sessions:
        for corner in (s for s in room.line.sections if s.kind == "sharp_right"):
            places = np.linspace(corner.start + 0.2, corner.end - 0.2, 20)
            commands = [
                np.column_stack(
                    [
                        np.interp(places, *_rising(lap.column("arc"), lap.column(name)))
                        for name in ("user_v", "user_w")
                    ]
                )
                for lap in (session[1], session[3])
            ]
            differences.append(np.abs(commands[0] - commands[1]).max(axis=1))
    assert np.median(differences) < 0.05
    assert np.mean(np.array(differences) < 0.1) > 0.8


def test_full_right_deflection_gives_what_the_limitation_leaves(sessions, room):
    """In the limited lap most people turn sharply with the stick at its right end."""
    full = 0
    for session in sessions:
        inside = [room.line.section(arc).kind == "sharp_right" for arc in session[1].column("arc")]
        full += np.mean(np.isclose(session[1].column("user_w")[inside], -0.15)) > 0.5
    assert full >= PEOPLE / 2


def test_commands_are_smooth(sessions):
    """No command jumps from step to step as white noise would."""
    for session in sessions:
        steps = np.abs(np.diff(session[0].column("user_v")))
        assert np.quantile(steps, 0.95) < 0.08


def test_the_same_numbers_make_the_same_lap(lab_office, room):
    """A lap is its random numbers; others make another lap."""
    laps = []
    for seed in (1, 1, 2):
        driver = person(lab_office, 3)
        driver.start_lap(1, np.random.default_rng(seed))
        laps.append(room.lap(driver))
    assert laps[0].rows == laps[1].rows
    assert laps[0].rows != laps[2].rows


@pytest.mark.parametrize(
    "pose",
    [Pose(0.14, -0.2, -2.2), Pose(1.42, -0.12, -2.47), Pose(2.2, -0.1, 1.9), Pose(0.9, 0.2, -2.8)],
)
def test_handed_back_at_an_odd_pose_one_still_finishes(lab_office, room, limitation, pose):
    """Facing the wrong way, near obstacles, with slow right turns: the driver gets free."""
    driver = person(lab_office, 4)
    driver.start_lap(2, np.random.default_rng(0))
    assert room.lap(driver, limitation=limitation, pose=pose).finished


def test_without_traits_a_typical_person_drives(lab_office, room):
    """The median person needs no drawing."""
    driver = make_driver("human", DriverSetup(lab_office, np.random.default_rng(0)))
    driver.start_lap(0, np.random.default_rng(0))
    assert room.lap(driver).finished


def _rising(arc, values):
    """Return a stream by arc length, without the steps that go back."""
    best = np.maximum.accumulate(arc)
    keep = np.concatenate([[True], np.diff(best) > 0])
    return arc[keep], values[keep]
