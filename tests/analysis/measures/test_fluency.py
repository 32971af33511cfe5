"""Fluency of working together."""

import numpy as np
import pyarrow as pa
import pytest

from analysis.measures.fluency import (
    concurrent_activity,
    functional_delay,
    human_idle,
    robot_idle,
)
from analysis.measures.streams import Steps


def lap(human, robot):
    """Return steps with both agents' activity given as strings of 0 and 1."""
    active = np.array([c == "1" for c in human])
    columns = {
        "t_s": np.arange(len(active)) * 0.1,
        "intent_v": np.where(active, 0.5, 0.0),
        "intent_w": np.zeros(len(active)),
        "control": np.where([c == "1" for c in robot], "model", "driver"),
    }
    return Steps(pa.table(columns))


def test_idle_and_concurrent_shares():
    """Shares of ten steps, counted by hand."""
    frame = lap("1111110000", "0000111100")
    assert human_idle(frame) == pytest.approx(0.4)
    assert robot_idle(frame) == pytest.approx(0.6)
    assert concurrent_activity(frame) == pytest.approx(0.2)


def test_a_pause_between_the_two_is_delay():
    """The human stops, two steps later the robot starts, three later the human again."""
    assert functional_delay(lap("1110000000011", "0000011110000"[:13])) == pytest.approx(4 / 13)


def test_overlap_is_negative_delay():
    """A robot that acts for three steps while the human still acts: minus three steps."""
    assert functional_delay(lap("1111111111", "0001110000")) == pytest.approx(-0.3)


def test_every_intervention_within_one_human_action_counts():
    """Two interventions during one long action overlap it twice."""
    assert functional_delay(lap("1111111111", "0110011000")) == pytest.approx(-0.4)


def test_one_agent_alone_has_no_hand_over():
    """Without a second agent there is no delay."""
    assert np.isnan(functional_delay(lap("1100110011", "0000000000")))
