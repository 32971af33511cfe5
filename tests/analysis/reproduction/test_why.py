"""The table of explanations, computed by hand from stand-ins of recorded studies."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from analysis.reproduction import why
from protocols.explanations import EXPLANATIONS

LAPS = ("demonstrator", "model after 1", "further demonstration", "model after 3")


def study(laps=LAPS, late=False):
    """Return two participants; p(h) is 1 from two steps before help, or only within it."""
    n = 50
    h = np.where(np.arange(n) >= 30, 1, -1)
    p = np.where(np.arange(n) >= (33 if late else 28), 0.9, 0.1)
    steps = pd.DataFrame({"t_s": np.arange(n) * 0.1, "h": h, "h_would": h, "p_help": p})
    rows = [
        {
            "participant": who,
            "lap": i,
            "condition": c,
            "duration_s": 40.0 + 2 * i + k * (i == 1),
            "interventions": 3 + k,
        }
        for k, who in enumerate(("P0001", "P0002"))
        for i, c in enumerate(laps)
    ]
    return SimpleNamespace(
        laps=pa.Table.from_pandas(pd.DataFrame(rows)), steps=lambda *_: pa.Table.from_pandas(steps)
    )


@pytest.mark.parametrize(("late", "anticipated"), [(False, 1.0), (True, 0.0)])
def test_a_row_by_hand(late, anticipated):
    """Means, the paired difference, takeovers, and whether p(h) had risen before."""
    row = why._row(EXPLANATIONS[0], study(late=late))
    assert (row["demonstrator"], row["after_1"], row["after_3"]) == (40.0, 42.5, 46.0)
    assert row["behind_s"] == pytest.approx(2.5)
    assert row["low"] < 2.5 < row["high"]
    assert row["takeovers"] == 3.5
    assert row["anticipated"] == anticipated
    assert row["auc"] > 0.9


def test_people_have_no_third_demonstration():
    """Their lap with the model is compared with their lap with the demonstrator."""
    people = next(e for e in EXPLANATIONS if e.name == "stick")
    row = why._row(people, study(("human-assisted", "model-assisted")))
    assert row["behind_s"] == pytest.approx(2.5)
    assert np.isnan(row["after_3"])


def test_the_section_says_what_a_change_shows(monkeypatch, tmp_path):
    """A row for each explanation, and that sufficiency here is no evidence about 2013."""
    monkeypatch.setattr(
        why, "open_study", lambda path: study(
            LAPS if path.name not in ("people", "stick", "stick-to-both")
            else ("human-assisted", "model-assisted")
        ),
    )  # fmt: skip
    section = why.why_section(why.why_table(tmp_path))
    text, shown = section.blocks
    assert "no evidence" in text.text
    assert len(shown.rows) == len(EXPLANATIONS)
