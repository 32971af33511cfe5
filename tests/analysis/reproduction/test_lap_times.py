"""Lap times by condition, against numbers worked out by hand."""

from types import SimpleNamespace

import pandas as pd
import pytest
from scipy import stats

from analysis.reproduction.driver_rows import PARTS, driver_rows
from analysis.reproduction.lap_times import MARGIN, lap_time_table

TIMES = {
    "limited": [58.0, 60.0, 62.0],
    "demonstrator": [40.0, 41.0, 42.0],
    "model after 1": [43.0, None, 46.0],
}


def frames(times):
    """Return laps of some replicates, as an analysis meets them."""
    laps = [
        {"participant": f"P{i:04d}", "condition": condition, "lap_time_s": time, "interventions": i}
        for condition, column in times.items()
        for i, time in enumerate(column)
    ]
    return SimpleNamespace(laps=pd.DataFrame(laps), conditions=tuple(times))


@pytest.fixture
def table():
    """Return the table of the laps above, by condition."""
    return lap_time_table(frames(TIMES)).set_index("condition")


def test_means_count_finished_laps(table):
    """Unfinished laps are counted, not averaged."""
    row = table.loc["model after 1"]
    assert (row["n"], row["unfinished"], row["mean_s"]) == (2, 1, 44.5)
    assert table.loc["demonstrator", "sd_s"] == pytest.approx(1.0)
    assert table.loc["limited", ["median_s", "longest_s", "takeovers"]].tolist() == [60, 62, 1]
    low, high = stats.t.interval(0.95, 2, 60.0, 2 / 3**0.5)
    assert table.loc["limited", ["low_s", "high_s"]].tolist() == pytest.approx([low, high])


def test_speedup_is_the_ratio_of_means(table):
    """Limited over condition, in percent."""
    assert table.loc["demonstrator", "speedup_percent"] == pytest.approx(100 * 180 / 123)
    assert table.loc["model after 1", "speedup_percent"] == pytest.approx(100 * 120 / 89)


def test_differences_are_within_replicates(table):
    """Behind the demonstrator: 3 s and 4 s, of the two replicates with both laps."""
    row = table.loc["model after 1"]
    assert row["behind_s"] == pytest.approx(3.5)
    low, high = stats.t.interval(0.90, 1, 3.5, 0.5)
    assert (row["tost_low"], row["tost_high"]) == pytest.approx((low, high))


def test_tost_agrees_with_two_t_tests(table):
    """The larger p of two one-sided paired t-tests against the margin."""
    differences = [18.0, 19.0, 20.0]
    theirs = max(
        stats.ttest_1samp(differences, -MARGIN, alternative="greater").pvalue,
        stats.ttest_1samp(differences, MARGIN, alternative="less").pvalue,
    )
    assert table.loc["limited", "tost_p"] == pytest.approx(theirs)


def test_ks_is_over_laps(table):
    """Exact two-sample test against the demonstrator's laps."""
    theirs = stats.ks_2samp(TIMES["limited"], TIMES["demonstrator"])
    assert table.loc["limited", "ks"] == theirs.statistic
    assert table.loc["limited", "ks_p"] == pytest.approx(theirs.pvalue)


def test_the_demonstrator_is_not_compared_with_itself(table):
    """Nothing to say of it."""
    assert table.loc["demonstrator", ["behind_s", "ks", "tost_p"]].isna().all()


def test_rows_take_the_papers_numbers_and_verdicts():
    """A driver exactly like the paper's reproduces what has a tolerance."""
    like = {"baseline": 34.59, "limited": 59.11, "demonstrator": 40.5, "model after 1": 42.6}
    times = {
        name: [like.get(name, 40.4) + off for off in wobble]
        for name, wobble in zip(
            PARTS, [(-0.2, 0.1, 0.1), (0.1, -0.2, 0.1), *[(0.1, 0.1, -0.2)] * 6], strict=True
        )
    }
    times["model after 3"] = [40.5, 40.4, 40.3]
    rows = {row.quantity: row for row in driver_rows(lap_time_table(frames(times)))}
    judged = {name: row.verdict for name, row in rows.items() if row.verdict != "none"}
    assert judged == dict.fromkeys(
        ["rd lap baseline", "rd lap limited", "rd lap demonstrator",
         "model after 1 minus demonstrator", "tost model after 3"], "holds",
    )  # fmt: skip
    assert rows["speedup demonstrator"].ours == pytest.approx(146, abs=0.5)
    assert rows["speedup model after 1"].ours == pytest.approx(139, abs=0.5)
