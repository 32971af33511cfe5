"""Getting free: when it starts, what is tried, and when it ends."""

import numpy as np
import pytest

from lad.command import STILL, Command
from participants.planning.surroundings import known_raster
from participants.recovery import LINGERING, MOVEMENTS, Recovery
from participants.sight import Sight
from protocols.pose import Pose

AHEAD = Command(0.5, 0.0)
HERE = Pose(0.0, 0.0, 0.0)


def sight(t, pose=HERE, velocity=STILL):
    """Return what there is to see; the scan does not matter."""
    return Sight(t, pose, velocity, np.array([4.0]), np.array([0.0]), 0.6, 0, False)


@pytest.fixture
def recovery(lab_office):
    """Return a recovery of a driver with a second's patience."""
    return Recovery(known_raster(lab_office), 1.0)


def test_standing_against_ones_will_starts_it(recovery):
    """After the patience, and not before, a movement is tried for at least half a second."""
    answers = [recovery.movement(sight(t / 10), AHEAD, 0.0) for t in range(16)]
    assert answers[:11] == [None] * 11
    assert answers[12] in MOVEMENTS
    assert answers[12:16] == [answers[12]] * 4


def test_who_wants_to_stand_is_not_stuck(recovery):
    """Standing at will never starts it."""
    assert all(recovery.movement(sight(t / 10), STILL, 0.0) is None for t in range(300))


def test_every_movement_has_its_turn(recovery):
    """While nothing helps, all of them are tried before any is tried again."""
    tried = []
    for t in range(4000):
        answer = recovery.movement(sight(t / 10), AHEAD, 0.5)
        if answer is not None and (not tried or answer != tried[-1]):
            tried.append(answer)
    assert set(tried[: len(MOVEMENTS)]) == set(MOVEMENTS)


def test_lingering_counts_as_stuck(recovery):
    """To and fro in one place for long is no getting on, though the chair never stands."""
    begun = None
    for t in range(300):
        pose = Pose(0.05 * (t % 2), 0.0, 0.0)
        answer = recovery.movement(sight(t / 10, pose, Command(0.2, 0.0)), AHEAD, 0.0)
        if answer is not None:
            begun = t / 10
            break
    assert begun == pytest.approx(LINGERING, abs=0.3)


def test_help_ends_it(recovery):
    """A takeover ends the attempt, and patience starts again."""
    for t in range(13):
        trying = recovery.movement(sight(t / 10), AHEAD, 0.0)
    assert trying is not None
    recovery.helped()
    assert recovery.movement(sight(1.3), AHEAD, 0.0) is None
