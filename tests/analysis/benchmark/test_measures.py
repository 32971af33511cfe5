"""Measures of a helped lap and of the demonstration after it, on steps made by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from analysis.benchmark.measures import measures_of


def steps(n=10, **columns):
    """Return a lap's steps with every column the measures read."""
    base = {
        "t_s": np.arange(n) * 0.1,
        "control": ["driver"] * n,
        "section_kind": ["straight"] * n,
        "p_help": np.full(n, 0.25),
        "h_would": np.full(n, -1.0),
        "h": np.full(n, -1.0),
        "a_v": np.full(n, np.nan),
        "a_w": np.full(n, np.nan),
        "mean_v": np.zeros(n),
        "mean_w": np.zeros(n),
        "variance": np.full(n, 0.01),
    }
    return pa.Table.from_pandas(pd.DataFrame(base | columns))


def study(laps, by_lap):
    """Return a stand-in for a study that is read."""
    return SimpleNamespace(
        laps=pa.Table.from_pandas(pd.DataFrame(laps)), steps=lambda participant, lap: by_lap[lap]
    )


def lap(number, condition, assistant, duration, **more):
    """Return a row of the laps table."""
    return {
        "participant": "P0001", "lap": number, "condition": condition, "assistant": assistant,
        "duration_s": duration, "completed": True, "interventions": 0,
    } | more  # fmt: skip


def test_every_measure_by_hand():
    """Lap times against both references, chatter, Brier scores, onset, coverage and density."""
    helped = [-1.0] * 4 + [1.0] * 2 + [-1.0] * 4
    control = ["driver", "model", "driver"] + ["model"] * 6 + ["driver"]
    kinds = ["soft_right"] * 2 + ["left"] * 2 + ["straight"] * 6
    a_w = [np.nan] * 4 + [0.1, 0.3] + [np.nan] * 4
    a_v = [np.nan] * 4 + [0.0, 0.0] + [np.nan] * 4
    p = [0.0] * 4 + [0.8, 1.0] + [0.0] * 4
    found = measures_of(
        study(
            [
                lap(0, "alone", "none", 59.0),
                lap(1, "demonstration", "demonstrator", 40.0),
                lap(2, "after 1", "model", 42.0, interventions=2),
                lap(3, "test", "demonstrator", 41.0),
            ],
            {
                2: steps(control=control, section_kind=kinds),
                3: steps(h=helped, h_would=helped, a_v=a_v, a_w=a_w, p_help=p),
            },
        )
    ).iloc[0]
    assert found["demonstrations"] == 1
    assert found["lap_s"] == 42.0
    assert found["minus_demonstrator_s"] == pytest.approx(1.5)
    assert found["minus_alone_s"] == pytest.approx(-17.0)
    assert found["chatter"] == 1.0
    assert found["brier_own"] == pytest.approx(0.0625)
    assert found["help_elsewhere"] == pytest.approx(0.5)
    assert found["brier_demonstrated"] == pytest.approx(0.004)
    assert found["p_at_onset"] == pytest.approx(0.8)
    assert found["coverage_90"] == pytest.approx(0.75)
    by_hand = -math.log(2 * math.pi * 0.01) - 0.5 * np.mean([0.01, 0.09]) / 0.01
    assert found["log_density"] == pytest.approx(by_hand)


def test_an_assistant_without_variance_has_no_coverage():
    """What was not said is missing, not 0."""
    helped = [1.0] * 3 + [-1.0] * 7
    a = [0.1] * 3 + [np.nan] * 7
    found = measures_of(
        study(
            [
                lap(0, "alone", "none", 59.0),
                lap(1, "after 1", "model", 42.0),
                lap(2, "test", "demonstrator", 41.0),
            ],
            {1: steps(), 2: steps(h=helped, h_would=helped, a_v=a, a_w=a, variance=np.nan)},
        )
    ).iloc[0]
    assert math.isnan(found["coverage_90"])
    assert math.isnan(found["log_density"])
    assert found["brier_demonstrated"] > 0


def test_a_lap_from_which_the_person_withdrew_has_no_time():
    """Leaving after 20 s is not a fast lap; it still counts as not finished."""
    gone = lap(1, "after 1", "model", 20.0, completed=False, end_reason="withdrew")
    laps = [lap(0, "demonstration", "demonstrator", 40.0, end_reason="finished"), gone]
    found = measures_of(study(laps, {1: steps()})).iloc[0]
    assert math.isnan(found["lap_s"])
    assert math.isnan(found["minus_demonstrator_s"])
    assert found["finished"] == 0.0
