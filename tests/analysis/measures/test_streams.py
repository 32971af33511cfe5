"""What measures see of steps that another program recorded."""

import math

import numpy as np
import pyarrow as pa
import pytest

from analysis.measures.registry import MEASURES
from analysis.measures.streams import Steps, gaps, period, stream

TIMED = (
    "driving_time_s", "contact_time_s", "intervention_duration_s", "onset_lead_s", "missed_onsets",
    "needless_time_s", "sparc_user", "sparc_executed", "ldlj_user", "ldlj_executed",
    "functional_delay",
)  # fmt: skip


def test_sound_steps_have_no_gaps(steps):
    """Nothing to say about steps that we recorded."""
    assert gaps(Steps(pa.table(steps))) == ()


@pytest.mark.parametrize(
    "spoil",
    [np.floor, lambda t: t[::-1].copy(), lambda t: np.where(t == t[5], np.nan, t)],
    ids=["whole seconds", "reverse order", "one missing"],
)
def test_without_a_usable_time_what_needs_it_is_missing(steps, spoil):
    """No traceback, no number from a wrong clock; the rest is as it was."""
    sound, spoilt = Steps(pa.table(steps)), Steps(pa.table(steps | {"t_s": spoil(steps["t_s"])}))
    expected = {m.name: m.of(sound) for m in MEASURES}
    found = {m.name: m.of(spoilt) for m in MEASURES}
    assert math.isnan(period(spoilt))
    assert all(math.isnan(found[name]) for name in TIMED)
    rest = set(found) - set(TIMED)
    assert {n: found[n] for n in rest} == pytest.approx({n: expected[n] for n in rest}, nan_ok=True)
    said = "t_s does not increase from step to step: measures that need the time are missing"
    assert gaps(spoilt) == (said,)


@pytest.mark.parametrize("column", ["intent_v", "x_m", "offset_m", "clearance_m", "p_help", "t_s"])
@pytest.mark.parametrize("value", [math.inf, -math.inf])
def test_an_infinite_value_is_missing(steps, column, value):
    """Every measure is a number or missing, without a warning, and the column is named."""
    steps[column][5] = value
    lap = Steps(pa.table(steps))
    assert not any(math.isinf(m.of(lap)) for m in MEASURES)
    assert math.isnan(stream(lap, column)[5])
    assert gaps(lap)[0] == f"{column} is infinite in some steps: missing there"


@pytest.mark.parametrize("p", [7.0, -0.1])
def test_a_probability_out_of_range_is_missing(steps, p):
    """It is no prediction; the others stay."""
    sound = steps["p_help"].copy()
    steps["p_help"][5] = p
    lap = Steps(pa.table(steps))
    assert gaps(lap) == ("p_help is not between 0 and 1 in some steps: missing there",)
    seen = stream(lap, "p_help")
    assert math.isnan(seen[5])
    assert (np.delete(seen, 5) == np.delete(sound, 5)).all()


def test_a_single_step_is_no_gap():
    """One step has no length, but nothing in it is wrong."""
    assert gaps(Steps(pa.table({"t_s": [0.0]}))) == ()
