"""Unfinished laps: three estimands, and the rule that excludes by the outcome."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from analysis.estimands import timed_laps, worst_differences
from analysis.frames import study_frames
from analysis.lap_time_test import lap_time_test
from analysis.outcome_exclusion import excluded_as_unfinished, without_the_rule
from protocols.declared import Exclusion


@pytest.fixture
def frames(make_study):
    """Return eight people, one of whom ran into the limit in the limited lap (lap 2)."""
    return study_frames(make_study(participants=8, unfinished=frozenset({(1, 2)})))


def test_complete_pairs_leave_the_lap_out_and_the_limit_takes_it(frames):
    """No time, and 300 s."""
    pair = timed_laps(frames, "complete pairs")
    limit = timed_laps(frames, "limit")
    over = (pair["participant"] == "P0001") & (pair["condition"] == "limited")
    assert pair.loc[over, "lap_time_s"].isna().all()
    assert limit.loc[over, "lap_time_s"].tolist() == [300.0]
    assert limit.loc[~over, "lap_time_s"].equals(pair.loc[~over, "lap_time_s"])


def test_worst_rank_is_behind_every_finished_lap(frames):
    """The pair counts, with the largest rank; p is exact over eight pairs."""
    pairs = lap_time_test(frames, "limited", "baseline").test
    worst = lap_time_test(frames, "limited", "baseline", "worst rank").test
    assert (pairs.n, worst.n) == (7, 8)
    assert worst.statistic == 36  # all eight slower when limited
    assert worst.p == pytest.approx(2 / 2**8)


def test_two_unfinished_laps_do_not_differ():
    """One is worse by more than any pair, two are a zero, none stays as it is."""
    laps = pd.DataFrame(
        [(p, c, w) for p, pair in {"a": (1, 0), "b": (1, 1), "c": (0, 0), "d": (0, 1)}.items()
         for c, w in zip("xy", map(bool, pair), strict=True)],
        columns=["participant", "condition", "worst"],
    )  # fmt: skip
    d = pd.Series([np.nan, np.nan, 0.3, np.nan], index=list("abcd"))
    found = worst_differences(d, laps, "x", "y")
    assert found["a"] > 0.3
    assert found["b"] == 0
    assert found["c"] == 0.3
    assert found["d"] < -0.3


def test_a_rule_on_completed_laps_is_shown_with_and_without(make_study):
    """Who is excluded as unfinished comes back in the second table, and only there."""
    reason = "completed 3 laps; the protocol asks for 4"
    study = make_study(participants=8, excluded={2: reason, 3: "9 collisions; ..."})
    rules = Exclusion(min_completed_laps=4)
    protocol = study.protocol.model_copy(update={"exclusion": rules})
    header = study.header.model_copy(update={"protocol": protocol})
    frames = study_frames(replace(study, header=header))
    assert excluded_as_unfinished(frames) == ("P0002",)
    assert len(frames.participants) == 6
    assert {c.complete for c in without_the_rule(frames)} == {7}
    assert without_the_rule(study_frames(study)) == ()
