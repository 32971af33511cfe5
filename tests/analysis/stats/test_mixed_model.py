"""The mixed model: identification, fallback, and what is reported."""

import numpy as np
import pandas as pd
import pytest

import analysis.stats.mixed_model as module
from analysis.stats.mixed_model import lap_time_design, lap_time_model
from analysis.stats.permutation import sign_flip


def laps(n=12, turned=False, between=0.3, seed=0):
    """Return lap times of n people in four conditions; in turned order for every other one."""
    rng = np.random.default_rng(seed)
    conditions = ["baseline", "limited", "human", "model"]
    effect = {"baseline": 0.0, "limited": 0.4, "human": -0.1, "model": 0.1}
    rows = []
    for i in range(n):
        own = rng.normal(0, between)
        order = conditions[::-1] if turned and i % 2 else conditions
        for lap, condition in enumerate(order):
            log_time = 3.9 + own + effect[condition] + rng.normal(0, 0.1)
            rows.append((f"P{i}", condition, lap, np.exp(log_time)))
    return pd.DataFrame(rows, columns=["participant", "condition", "lap", "lap_time_s"])


def test_a_fixed_order_does_not_identify_the_lap():
    """Practice and condition are one column: the lap's place is left out."""
    assert not lap_time_design(laps(), "limited").with_lap
    assert lap_time_design(laps(turned=True), "limited").with_lap


def test_one_persons_order_does_not_tell_practice_from_condition():
    """The matrix is not singular, but the contrasts' variances are inflated many times."""
    order = {"baseline": 0, "limited": 2, "human": 1, "model": 3}
    swapped = laps()
    one = swapped["participant"] == "P3"
    swapped.loc[one, "lap"] = swapped.loc[one, "condition"].map(order)
    again = pd.concat([laps(), laps().query("participant == 'P3' and lap == 3").assign(lap=4)])
    for frame in (swapped, again):
        assert not lap_time_design(frame, "limited").with_lap
    half = laps()
    some = half["participant"].isin([f"P{i}" for i in range(6)])
    half.loc[some, "lap"] = 3 - half.loc[some, "lap"]
    assert lap_time_design(half, "limited").with_lap


def test_complete_data_give_the_paired_differences():
    """In a complete design the contrasts are the mean differences of log times."""
    frame = laps()
    wide = np.log(frame.pivot_table(index="participant", columns="condition", values="lap_time_s"))
    for found in lap_time_model(frame, "limited", np.random.default_rng(0)):
        condition = found.name.split()[0]
        assert found.estimate == pytest.approx((wide[condition] - wide["limited"]).mean(), abs=1e-6)
        assert found.checks[0] == "converged"
        assert found.n == 12


@pytest.mark.parametrize("seed", range(6))
def test_it_converges_where_people_hardly_differ(seed):
    """Between-person variance near zero is where the default optimiser fails."""
    found = lap_time_model(laps(between=1e-3, seed=seed), "limited", np.random.default_rng(0))
    assert all("mixed model" in f.method for f in found)
    assert all(np.isfinite(f.p) for f in found)


@pytest.mark.parametrize("defect", ["not converged", "exact zero", "error"])
def test_a_failed_fit_falls_back_on_a_permutation_test(monkeypatch, defect):
    """What was used instead, and why, is in the result."""
    frame = laps()
    real = module.MixedLM.fit

    def broken(self, **options):
        if defect == "error":
            raise np.linalg.LinAlgError("singular matrix")
        fit = real(self, **options)
        if defect == "not converged":
            fit.converged = False
        else:
            fit.fe_params[1] = 0.0
        return fit

    monkeypatch.setattr(module.MixedLM, "fit", broken)
    wide = np.log(frame.pivot_table(index="participant", columns="condition", values="lap_time_s"))
    for found in lap_time_model(frame, "limited", np.random.default_rng(0)):
        condition = found.name.split()[0]
        expected = sign_flip(wide[condition] - wide["limited"], np.random.default_rng(0))
        assert found.p == pytest.approx(expected.p)
        assert "sign flips" in found.method
        assert "the mixed model" in found.notes[1]


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
    assert "t on 31 df" in found[0].method
    assert f"{len(frame) - 2} laps of 12 participants; 2 without a time left out" in found[0].notes
