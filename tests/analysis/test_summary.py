"""The closing table of a run."""

import numpy as np
import pytest

from analysis.results import analyse
from analysis.summary import lap_summary


def test_one_row_per_condition_with_speedups_over_limited(study):
    """Means, the speedup over the limited condition, and the paper's means beside them."""
    table = lap_summary(analyse(study)).set_index("condition")
    assert list(table.index) == ["baseline", "limited", "human-assisted", "model-assisted"]
    assert np.isnan(table.loc["limited", "speedup_percent"])
    ratio = 100 * table.loc["limited", "mean_s"] / table["mean_s"]
    assisted = ["baseline", "human-assisted", "model-assisted"]
    assert table.loc[assisted, "speedup_percent"].tolist() == pytest.approx(
        ratio[assisted].tolist()
    )
    assert table["paper_mean_s"].tolist() == [48.5, 76.7, 44.55, 56.1]


def test_a_single_unfinished_lap_does_not_break_it(make_study):
    """No one finished the limited lap: no mean, no speedup, one unfinished."""
    table = lap_summary(analyse(make_study(participants=1, unfinished=frozenset({(1, 2)}))))
    limited = table.set_index("condition").loc["limited"]
    assert (limited["n"], limited["unfinished"]) == (0, 1)
    assert table["speedup_percent"].isna().all()
