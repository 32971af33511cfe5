"""A person acts on what there was to see a reaction time ago."""

import numpy as np
import pytest

from lad.command import STILL
from participants.human.perception import DelayedView
from participants.sight import Sight
from protocols.pose import Pose


def sight(t):
    """Return a sight of a moment."""
    return Sight(t, Pose(t, 0.0, 0.0), STILL, np.array([4.0]), np.array([0.0]), 0.6, 0, False)


@pytest.mark.parametrize(("delay", "seen"), [(0.0, 2.0), (0.1, 1.9), (0.25, 1.7), (0.3, 1.7)])
def test_the_view_is_late_by_the_delay(delay, seen):
    """The newest sight that is old enough, at a tenth of a second each."""
    view = DelayedView(delay)
    for step in range(21):
        now = view.see(sight(step / 10))
    assert now.t == pytest.approx(seen)


def test_the_first_sight_lasts_until_another_is_old_enough():
    """At the start one acts on what one saw before setting off."""
    view = DelayedView(0.5)
    assert [view.see(sight(step / 10)).t for step in range(6)] == [0.0] * 6
