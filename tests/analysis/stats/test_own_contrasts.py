"""Contrasts of log lap times with a spread of their own."""

import numpy as np
import pandas as pd
import pytest

from analysis.stats.mixed_model import lap_time_model
from analysis.stats.own_contrasts import own_contrasts


def laps(rng, n=12, spreads=(0.0, 0.17, 0.17, 0.02)):
    """Return null lap times: one condition differs by person, two others hardly from each other."""
    rows = []
    for i in range(n):
        shared = rng.normal(0, 0.15)
        for lap, (condition, spread) in enumerate(zip("abcd", spreads, strict=True)):
            noise = rng.normal(0, spread) + (shared if condition in "cd" else 0)
            rows.append((f"P{i}", condition, lap, np.exp(4 + noise)))
    return pd.DataFrame(rows, columns=["participant", "condition", "place", "lap_time_s"])


def test_with_complete_data_the_estimates_are_the_models():
    """Only intervals and tests differ."""
    rng = np.random.default_rng(0)
    frame = laps(rng)
    model = lap_time_model(frame, "a", rng)
    own = own_contrasts(frame, "a")
    assert [f.name for f in own] == [f.name for f in model]
    assert [f.estimate for f in own] == pytest.approx([f.estimate for f in model], abs=1e-6)
    assert "standard deviation of the contrast" in own[0].checks[0]


@pytest.mark.slow
def test_it_holds_its_size_whatever_the_spreads():
    """Of 400 null cohorts with unequal spreads, about 5% are rejected by each contrast."""
    rng = np.random.default_rng(1)
    p = np.array([[f.p for f in own_contrasts(laps(rng), "a")] for _ in range(400)])
    assert (np.mean(p <= 0.05, axis=0) <= 0.05 + 2.6 * np.sqrt(0.05 * 0.95 / 400)).all()


def test_missing_laps_leave_their_pairs():
    """Who lacks one of the two laps is in no contrast with it; nobody drove "z"."""
    frame = laps(np.random.default_rng(2))
    frame.loc[(frame["participant"] == "P0") & (frame["condition"] == "b"), "lap_time_s"] = np.nan
    n = {f.name[0]: f.n for f in own_contrasts(frame, "a")}
    assert n == {"b": 11, "c": 12, "d": 12}
    assert own_contrasts(frame, "z") == ()
