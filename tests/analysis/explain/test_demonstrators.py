"""How those who teach one model differ: by hand, and nothing where nothing can be compared."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from analysis.explain.demonstrators import demonstrated, demonstrators_of, disagreement
from protocols.condition import Condition, LimitationSettings
from protocols.laps import PlannedLap

SHOWN = {"limitation": LimitationSettings(), "assistant": "demonstrator", "training": True}
CONDITIONS = {
    "shown": Condition(**SHOWN),
    "by another": Condition(**SHOWN, demonstrator="another"),
    "corrected": Condition(assistant="model", training=True, corrections={}),
}
TURN = {"shown": -0.5, "by another": -0.3, "corrected": -0.9}
FROM = {"shown": 10, "by another": 14, "corrected": 2}


def steps(condition, participant):
    """Return forty steps in two sections; help in the second, from a step on, ten long."""
    n, start = 40, FROM[condition] + 10
    helped = (np.arange(n) >= start) & (np.arange(n) < start + 10)
    turn = TURN[condition] - 0.01 * int(participant[-1])
    return pd.DataFrame(
        {
            "section": ["first"] * 10 + ["second"] * 30,
            "arc_m": np.arange(n) * 0.1,
            "h": np.where(helped, 1, -1),
            "a_v": np.where(helped, 0.2, np.nan),
            "a_w": np.where(helped, turn, np.nan),
            "mean_v": 0.2,
            "mean_w": -0.5,
            "variance": 0.01,
        }
    )


def study(participants=3):
    """Return a stand-in for a recorded study: a lap of each condition for each participant."""
    rows = [
        {"participant": f"P000{p}", "lap": i, "condition": c, "training": True, "completed": True}
        for p in range(1, participants + 1)
        for i, c in enumerate(CONDITIONS)
    ]
    laps = tuple(PlannedLap(condition=c) for c in CONDITIONS)
    return SimpleNamespace(
        protocol=SimpleNamespace(conditions=CONDITIONS, laps=laps),
        laps=pa.Table.from_pandas(pd.DataFrame(rows)),
        steps=lambda p, lap: pa.Table.from_pandas(steps(list(CONDITIONS)[lap], p)),
    )


def test_who_teaches_is_read_from_the_conditions():
    """The cohort's demonstrator and the other, once each, in the order of their laps."""
    assert demonstrators_of(study().protocol) == ("own", "another")


def test_shares_and_differences_by_hand():
    """Help begins 0.4 m later and turns 0.2 rad/s less; laps of corrections do not count."""
    shown = demonstrated(study())
    assert set(shown["section"]) == {"second"}
    assert set(shown["lap"]) == {0, 1}
    assert shown["share"].tolist() == pytest.approx([1 / 3] * 6)
    found = disagreement(shown, "own", "another").set_index("measure")
    assert found.loc["begins_m", "difference"] == pytest.approx(-0.4)
    assert found.loc["turn", "difference"] == pytest.approx(-0.2)
    assert found.loc["speed", "difference"] == pytest.approx(0.0)
    assert (found["n"] == 3).all()
    assert found.loc["surprise", "difference"] > 0


def test_one_participant_gives_a_difference_without_an_interval():
    """Nothing is made up where there is no spread to see."""
    found = disagreement(demonstrated(study(1)), "own", "another").set_index("measure")
    assert found.loc["turn", "difference"] == pytest.approx(-0.2)
    assert np.isnan(found.loc["turn", ["low", "high"]].astype(float)).all()


def test_someone_who_never_helped_cannot_be_compared():
    """An empty table, with its columns."""
    found = disagreement(demonstrated(study()), "own", "nobody")
    assert found.empty
    assert "difference" in found
