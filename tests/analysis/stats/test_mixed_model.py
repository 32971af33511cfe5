"""The mixed model: identification, fallback, and what is reported."""

import numpy as np
import pandas as pd
import pytest

from analysis.stats.mixed_model import lap_time_design, lap_time_model
from analysis.stats.permutation import sign_flip

SQUARE = [[0, 1, 3, 2], [1, 2, 0, 3], [2, 3, 1, 0], [3, 0, 2, 1]]


def laps(n=12, turned=False, between=0.3, seed=0, square=False):
    """Return lap times of n people in four conditions; turned for every other one, or a square."""
    rng = np.random.default_rng(seed)
    conditions = ["baseline", "limited", "human", "model"]
    effect = {"baseline": 0.0, "limited": 0.4, "human": -0.1, "model": 0.1}
    rows = []
    for i in range(n):
        own = rng.normal(0, between)
        order = conditions[::-1] if turned and i % 2 else conditions
        order = [conditions[c] for c in SQUARE[i % 4]] if square else order
        for lap, condition in enumerate(order):
            log_time = 3.9 + own + effect[condition] + rng.normal(0, 0.1)
            rows.append((f"P{i}", condition, lap, np.exp(log_time)))
    return pd.DataFrame(rows, columns=["participant", "condition", "place", "lap_time_s"])


def test_a_fixed_order_does_not_identify_the_lap():
    """Practice and condition are one: the place is left out. So it is in ABCD / DCBA.

    There baseline and limited, and model and human, have changed places with one another only: what
    is symmetric in practice cannot be told from them. In a Williams square it can.
    """
    assert not lap_time_design(laps(), "limited").with_place
    assert not lap_time_design(laps(turned=True), "limited").with_place
    assert lap_time_design(laps(square=True), "limited").with_place


def test_one_persons_order_does_not_tell_practice_from_condition():
    """Of twelve, the order of one leaves the matrix singular or a contrast inflated."""
    few, fixed = laps(square=True), laps()
    mixed = pd.concat([few[few["participant"] == "P1"], fixed[fixed["participant"] != "P1"]])
    assert not lap_time_design(mixed, "limited").with_place


def test_complete_data_give_the_paired_differences():
    """In a complete design the contrasts are the mean differences of log times."""
    frame = laps()
    wide = np.log(frame.pivot_table(index="participant", columns="condition", values="lap_time_s"))
    for found in lap_time_model(frame, "limited", np.random.default_rng(0)):
        condition = found.name.split()[0]
        assert found.estimate == pytest.approx((wide[condition] - wide["limited"]).mean(), abs=1e-6)
        assert found.n == 12


@pytest.mark.parametrize("seed", range(6))
def test_it_converges_where_people_hardly_differ(seed):
    """Between-person variance near zero is where the default optimiser fails."""
    found = lap_time_model(laps(between=1e-3, seed=seed), "limited", np.random.default_rng(0))
    assert all("mixed model" in f.method for f in found)
    assert all(np.isfinite(f.p) for f in found)


def test_without_residual_spread_a_permutation_test_takes_its_place():
    """Everybody's laps differ by the same factor: there is nothing to estimate an error from."""
    rows = [
        (f"P{i}", c, at, (40 + i) * factor)
        for i in range(6)
        for at, (c, factor) in enumerate({"limited": 1.5, "baseline": 1.0}.items())
    ]
    frame = pd.DataFrame(rows, columns=["participant", "condition", "place", "lap_time_s"])
    (found,) = lap_time_model(frame, "limited", np.random.default_rng(0))
    expected = sign_flip(np.full(6, np.log(1 / 1.5)), np.random.default_rng(0))
    assert found.p == pytest.approx(expected.p)
    assert "sign flips" in found.method
    assert any("cannot be fitted" in note for note in found.notes)


def test_too_few_laps_say_why():
    """One participant cannot be modelled; a reference nobody drove gives nothing."""
    found = lap_time_model(laps(n=1), "limited", np.random.default_rng(0))
    assert all("too few" in f.why_not for f in found)
    assert lap_time_model(laps(), "nobody", np.random.default_rng(0)) == ()


def test_unfinished_laps_are_left_out():
    """A lap without a time is no lap of the model."""
    frame = laps()
    frame.loc[[1, 6], "lap_time_s"] = np.nan
    found = lap_time_model(frame, "limited", np.random.default_rng(0))
    assert found[0].n == 12
    assert "Kenward-Roger" in found[0].method
    assert f"{len(frame) - 2} laps of 12 participants; 2 without a time left out" in found[0].notes
