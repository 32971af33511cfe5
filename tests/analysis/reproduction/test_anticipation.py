"""By how long p(h) precedes the demonstrator's takeover."""

import numpy as np
import pytest

from analysis.reproduction.anticipation import leads
from analysis.reproduction.teaching import PredictedLap


def lap(p_help, helped, period=0.1):
    """Return a lap with these predictions."""
    n = len(p_help)
    return PredictedLap(
        lap=0, t=np.arange(n) * period, helped=np.array(helped, dtype=bool),
        action=np.full((n, 2), np.nan), p_help=np.array(p_help, dtype=float),
        mean=np.zeros((n, 2)), variance=np.ones(n),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("p_help", "expected"),
    [
        ([0.1, 0.1, 0.3, 0.4, 0.9, 0.9], 0.2),  # two steps before
        ([0.1, 0.1, 0.1, 0.1, 0.9, 0.9], 0.0),  # with it
        ([0.1, 0.1, 0.1, 0.1, 0.2, 0.9], -0.1),  # a step after
        ([0.3, 0.3, 0.1, 0.3, 0.9, 0.9], 0.1),  # a rise that ended does not count
        ([0.3, 0.3, 0.3, 0.3, 0.9, 0.9], 0.4),  # since the start of the lap
        ([0.1, 0.1, 0.1, 0.1, 0.1, 0.1], np.nan),  # never
        ([0.1, 0.1, 0.1, 0.25, 0.25, 0.1], 0.1),  # 0.25 itself has risen
    ],
)
def test_the_lead_is_counted_from_the_rise_that_lasts(p_help, expected):
    """Help begins in the fifth of six steps of 0.1 s."""
    found = leads([lap(p_help, [0, 0, 0, 0, 1, 1])])
    assert found == pytest.approx([expected], nan_ok=True)


def test_each_takeover_has_a_lead_of_its_own():
    """Two takeovers, two laps."""
    one = lap([0.1, 0.5, 0.9, 0.1, 0.1, 0.9], [0, 0, 1, 0, 0, 1])
    assert leads([one, one]) == pytest.approx([0.1, 0.0, 0.1, 0.0])


def test_a_lap_without_help_has_none():
    """Nothing to anticipate."""
    assert leads([lap([0.9, 0.9], [0, 0])]).size == 0
