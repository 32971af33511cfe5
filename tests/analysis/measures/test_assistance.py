"""How much help, when, and whether user and assistant wanted the same."""

import numpy as np
import pyarrow as pa
import pytest

from analysis.measures.agreement import agreement, opposition
from analysis.measures.assistance import assisted_fraction, intervention_duration, interventions
from analysis.measures.collisions import collisions, contact_time
from analysis.measures.streams import Steps
from analysis.measures.timing import missed_onsets, needless_time, onset_lead
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE


def lap(helped, wanted=None):
    """Return steps with help and the demonstrator's wish given as strings of 0 and 1."""
    on = np.array([c == "1" for c in helped])
    columns = {"t_s": np.arange(len(on)) * 0.1, "control": np.where(on, "model", "driver")}
    if wanted is not None:
        columns["h_would"] = [1 if c == "1" else -1 for c in wanted]
    return Steps(pa.table(columns))


def test_interventions_are_counted_timed_and_shared():
    """Two stretches of two and four steps in twelve."""
    frame = lap("011001111000")
    assert interventions(frame) == 2
    assert assisted_fraction(frame) == pytest.approx(0.5)
    assert intervention_duration(frame) == pytest.approx(0.3)


def test_help_before_the_demonstrator_leads():
    """Help two steps before the demonstrator's onset leads by 0.2 s; later help lags."""
    assert onset_lead(lap("0011110000", "0000110000")) == pytest.approx(0.2)
    assert onset_lead(lap("0000011000", "0001111000")) == pytest.approx(-0.2)


def test_onsets_without_help_are_missed_not_averaged():
    """Of two onsets one is helped at once: lead 0, half of them missed."""
    frame = lap("0110000000" + "0" * 40, "0110000000" + "0" * 35 + "11000")
    assert onset_lead(frame) == pytest.approx(0.0)
    assert missed_onsets(frame) == pytest.approx(0.5)


def test_help_long_before_belongs_to_something_else():
    """Help that ended four seconds before the onset does not count as early."""
    frame = lap("11" + "0" * 60, "0" * 45 + "111" + "0" * 14)
    assert np.isnan(onset_lead(frame))
    assert missed_onsets(frame) == 1


def test_needless_help_is_help_the_demonstrator_would_not_give():
    """Three of five helped steps are beyond the demonstrator's wish."""
    assert needless_time(lap("0111110", "0001100")) == pytest.approx(0.3)


def commands(user, assistant):
    """Return one helped step per pair of commands in shares of full deflection."""
    user, assistant = np.array(user), np.array(assistant)
    columns = {
        "t_s": np.arange(len(user)) * 0.1,
        "control": ["demonstrator"] * len(user),
        "intent_v": user[:, 0] * MAX_SPEED,
        "intent_w": user[:, 1] * MAX_TURN_RATE,
        "a_v": assistant[:, 0] * MAX_SPEED,
        "a_w": assistant[:, 1] * MAX_TURN_RATE,
    }
    return Steps(pa.table(columns))


def test_same_direction_agrees_whatever_the_strength():
    """Half the stick in the same direction is full agreement."""
    assert agreement(commands([[1, -1]], [[0.5, -0.5]])) == pytest.approx(1.0)


def test_opposite_directions_oppose():
    """One step apart, one step together: opposed half of the time, mean cosine zero."""
    frame = commands([[1, 0], [1, 0]], [[-1, 0], [0.3, 0]])
    assert opposition(frame) == pytest.approx(0.5)
    assert agreement(frame) == pytest.approx(0.0)


def test_a_stick_at_rest_neither_agrees_nor_opposes():
    """A user who lets go has no direction."""
    assert np.isnan(agreement(commands([[0, 0]], [[1, 0]])))


def test_contacts_are_counted_once_each():
    """A contact of three steps is one collision, and 0.3 s of contact."""
    contact = pa.array([False, True, True, True, False, False])
    frame = Steps(lap("000000").table.append_column("contact", contact))
    assert collisions(frame) == 1
    assert contact_time(frame) == pytest.approx(0.3)
