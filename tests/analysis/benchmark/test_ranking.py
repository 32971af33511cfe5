"""Ranks and paired differences, on numbers worked out by hand."""

import numpy as np
import pandas as pd
import pytest

from analysis.benchmark.measures import MEASURES
from analysis.benchmark.ranking import cell_table, ranking
from analysis.benchmark.write import page


def measures(times):
    """Rows from {(setting, demonstrations, assistant): lap times of replicates}."""
    rows = []
    for (setting, n, assistant), values in times.items():
        for i, value in enumerate(values):
            rows.append(
                dict.fromkeys(MEASURES, 0.0)
                | {"setting": setting, "demonstrations": n, "assistant": assistant}
                | {"participant": f"P{i}", "minus_demonstrator_s": value, "finished": 1.0}
            )
    return pd.DataFrame(rows)


TIMES = {
    ("a", 1, "good"): [0.0, 1.0, 2.0],
    ("a", 1, "bad"): [2.0, 3.0, 4.0],
    ("b", 1, "good"): [5.0, 5.0, 5.0],
    ("b", 1, "bad"): [4.0, 4.0, 4.0],
    ("b", 3, "good"): [0.0, 0.0, 0.0],
    ("b", 3, "bad"): [3.0, 3.5, 4.0],
}


def test_mean_rank_and_pairs_by_hand():
    """Good is first in two of three cells; the difference is taken replicate by replicate."""
    found = ranking(measures(TIMES)).set_index("assistant")
    assert list(found.index) == ["good", "bad"]
    assert found.loc["good", "mean_rank"] == pytest.approx(4 / 3)
    assert found.loc["bad", "mean_rank"] == pytest.approx(5 / 3)
    # Replicates' means: good 5/3, 2, 7/3; bad 3, 3.5, 4.
    assert found.loc["bad", "slower_s"] == pytest.approx(np.mean([4 / 3, 1.5, 5 / 3]))
    assert found.loc["bad", "pairs"] == 3
    assert found.loc["bad", "low"] < 1.5 < found.loc["bad", "high"]


def test_a_cell_that_one_missed_is_not_ranked():
    """An assistant that cannot take part somewhere does not win there by absence."""
    times = dict(TIMES)
    times["elsewhere", 3, "good"] = [99.0] * 3
    found = ranking(measures(times)).set_index("assistant")
    assert found.loc["good", "cells"] == 3
    assert found.loc["good", "mean_rank"] == pytest.approx(4 / 3)


def test_order_of_rows_changes_nothing():
    """Shuffled rows give the same ranking."""
    frame = measures(TIMES)
    shuffled = frame.sample(frac=1.0, random_state=1)
    pd.testing.assert_frame_equal(ranking(frame), ranking(shuffled))


def test_the_page_has_every_cell_and_a_dash_for_what_is_missing():
    """One line a cell; an interval of one replicate is a dash."""
    frame = measures({("a", 1, "only"): [1.25]})
    text = page(cell_table(frame), ranking(frame))
    assert "| 1 | only | 1 | 0.0 (0.0) | +1.25 (+1.25) | – |" in text


def test_the_worst_replicate_stands_beside_the_mean():
    """A mean below 45 s does not hide a lap above."""
    frame = measures({("a", 1, "only"): [1.0, 3.0]})
    frame["lap_s"] = [41.0, 52.0]
    cell = cell_table(frame).iloc[0]
    assert (cell["lap_s"], cell["worst_lap_s"]) == (46.5, 52.0)
    assert cell["worst_minus_demonstrator_s"] == 3.0
    assert "| 46.5 (52.0) | +2.00 (+3.00) |" in page(cell_table(frame), ranking(frame))
