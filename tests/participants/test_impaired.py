"""Whatever the impairment: a driver who falls silent stops, and the link is the driver's own."""

import numpy as np
import pytest

from lad.command import Command
from participants.registry import make_impaired
from participants.setup import ImpairmentSetup
from participants.sight import Sight
from protocols.pose import Pose
from protocols.shipped_parts import IMPAIRMENTS


class Living:
    """A driver on a link: it answers in the first steps only."""

    kind = "live"

    def __init__(self):
        self.steps = 0

    def start_lap(self, lap, rng):
        pass

    def act(self, sight):
        self.steps += 1
        return Command(0.5, 0.1) if self.steps <= 3 else None

    def telemetry(self):
        return {"driver_device": "keyboard"}


def sight(step):
    """Return what there is to see in a step; nobody here looks at it."""
    nothing = np.full(21, 4.0)
    return Sight(
        0.1 * step, Pose(0, 0, 0), Command(0, 0), nothing, nothing, 0.5, 0, False, False, "none"
    )


@pytest.fixture(params=IMPAIRMENTS)
def impaired(request):
    """Return each shipped impairment around a living driver, as a session makes it."""
    setup = ImpairmentSetup(Living(), 0.5, np.random.default_rng(1), {})
    driver = make_impaired(request.param, setup)
    driver.start_lap(0, np.random.default_rng(2))
    return driver


def test_silence_stays_silence(impaired):
    """No trembling, jerking or late hand keeps a chair moving whose driver is gone."""
    answers = [impaired.act(sight(step)) for step in range(8)]
    assert all(answer is not None for answer in answers[:3])
    assert answers[3:] == [None] * 5


def test_the_link_is_the_drivers(impaired):
    """Its device and its ages reach the record, and it stays a living person."""
    assert impaired.kind == "live"
    assert impaired.telemetry() == {"driver_device": "keyboard"}
