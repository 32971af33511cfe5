"""Every test and estimate against R, on committed data (tests/data/r)."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy import stats as scipy_stats

from analysis.stats.cronbach_alpha import cronbach_alpha
from analysis.stats.effect_size import cohen_dz, rank_biserial
from analysis.stats.holm import holm
from analysis.stats.kolmogorov_smirnov import asymptotic_p, two_sample_ks
from analysis.stats.mean_difference import mean_difference
from analysis.stats.mixed_model import lap_time_model
from analysis.stats.proportional_odds import proportional_odds
from analysis.stats.random_intercept import fit_random_intercept
from analysis.stats.ratio import mean_of_ratios, ratio_of_means
from analysis.stats.signed_rank import _normal_p, signed_rank, signed_ranks
from analysis.stats.tost import paired_tost

R = Path(__file__).parents[2] / "data" / "r"
REFERENCE = pd.read_csv(R / "reference.csv", index_col="name")["value"]


def r(name):
    """Return R's value, to compare closed forms with."""
    return pytest.approx(REFERENCE[name], rel=1e-6, abs=1e-6)


def r_optimum(name):
    """Return R's value, to compare optima with."""
    return pytest.approx(REFERENCE[name], abs=1e-4)


@pytest.fixture
def lap_times():
    """Return lap times of the fixed order: participants by conditions."""
    laps = pd.read_csv(R / "laps.csv")
    return laps.pivot_table(index="participant", columns="condition", values="lap_time_s")


@pytest.fixture
def item():
    """Return answers with ties and zeros."""
    return pd.read_csv(R / "item.csv")


@pytest.fixture
def difference(lap_times):
    """Return the model's lap times minus the demonstrator's."""
    return (lap_times["model"] - lap_times["human"]).to_numpy()


def test_signed_rank_without_ties(difference):
    """wilcox.test(exact, conf.int): statistic, p, pseudomedian and interval."""
    found = signed_rank(difference)
    assert found.statistic == r("signed_rank.statistic")
    assert found.p == r("signed_rank.p")
    assert found.estimate == r("signed_rank.estimate")
    assert found.low == r("signed_rank.low")
    assert found.high == r("signed_rank.high")


@pytest.mark.parametrize("zeros", ["pratt", "wilcoxon"])
def test_signed_rank_with_ties_and_zeros(item, zeros):
    """coin::wilcoxsign_test, exact and asymptotic, for both ways with zeros."""
    d = (item["condition"] - item["reference"]).to_numpy(dtype=float)
    assert signed_rank(d, zeros=zeros).p == r(f"signed_rank.{zeros}.exact_p")
    kept, ranks = signed_ranks(d, zeros)
    asymptotic = _normal_p(ranks, float(ranks[kept > 0].sum()))
    assert asymptotic == r(f"signed_rank.{zeros}.asymptotic_p")


def test_kolmogorov_smirnov(lap_times, item):
    """ks.test: exact without ties, exact with ties, asymptotic."""
    found = two_sample_ks(lap_times["human"], lap_times["model"], same_people=True)
    assert found.statistic == r("ks.statistic")
    assert found.p == r("ks.exact_p")
    assert asymptotic_p(found.statistic, 12, 12) == r("ks.asymptotic_p")
    tied = two_sample_ks(item["reference"], item["condition"], same_people=True)
    assert tied.statistic == r("ks.ties.statistic")
    assert tied.p == r("ks.ties.exact_p")


def test_holm():
    """p.adjust."""
    adjusted = holm([0.01, 0.04, 0.03, 0.005, 0.2])
    assert adjusted == pytest.approx([REFERENCE[f"holm.{i}"] for i in range(1, 6)])


def test_mean_difference(difference):
    """t.test(paired = TRUE)."""
    found = mean_difference(difference)
    for name in ("estimate", "low", "high", "statistic", "p"):
        assert getattr(found, name) == r(f"mean_difference.{name}")


def test_effect_sizes(difference):
    """Written out in R."""
    rng = np.random.default_rng(0)
    assert cohen_dz(difference, rng).estimate == r("d_z")
    assert rank_biserial(difference, rng).estimate == r("rank_biserial")


@pytest.mark.parametrize("estimate", [ratio_of_means, mean_of_ratios])
def test_speedups(lap_times, estimate):
    """Fieller's interval found with uniroot and t.test; t.test of the ratios."""
    found = estimate(lap_times["limited"], lap_times["model"])
    assert found.estimate == r(estimate.__name__)
    assert found.low == r(f"{estimate.__name__}.low")
    assert found.high == r(f"{estimate.__name__}.high")


def test_tost(difference):
    """Two one-sided t-tests written out in R."""
    found = paired_tost(difference, margin=10.0)
    for name in ("p", "statistic", "low", "high"):
        assert getattr(found, name) == r(f"tost.{name}")


def test_mixed_model_in_a_fixed_order():
    """lme4::lmer; the lap's place is not identified; t on the analysis of variance's df."""
    laps = pd.read_csv(R / "laps.csv").rename(columns={"lap": "place"})
    for found in lap_time_model(laps, "limited", np.random.default_rng(0)):
        condition = found.name.split()[0]
        assert found.estimate == r_optimum(f"lmer.{condition}")
        error = found.estimate / found.statistic
        assert error == r_optimum(f"lmer.{condition}.se")
        df = REFERENCE["aov.df_within"]
        p = 2 * scipy_stats.t.sf(abs(found.statistic), df)
        assert found.p == pytest.approx(p)
        assert f"t on {df:.0f} Kenward-Roger df" in found.method
        assert "not identified" in found.method


MIXED = pd.read_csv(R / "mixed_model.csv", index_col="name")["value"]


def mixed_cases():
    """Return fixtures with missing laps and groups: data, columns of the matrix by R's names."""
    square = pd.read_csv(R / "laps_square.csv")
    groups = pd.read_csv(R / "laps_groups.csv")
    part = groups[groups["condition"] != "baseline"]
    six = pd.read_csv(R / "laps_six_people.csv")
    conditions = ("baseline", "human", "model")

    def at(frame, column, value):
        return (frame[column] == value).to_numpy(dtype=float)

    def columns(frame):
        return {f"condition{c}": at(frame, "condition", c) for c in conditions}

    places = {f"place{p}": at(square, "place", p) for p in (2, 3, 4)}
    b = at(groups, "group", "b")
    crossed = {f"groupb:{name}": b * c for name, c in columns(groups).items()}
    return {
        "square": (square, columns(square) | places),
        "missing": (square, columns(square)),
        "groups": (groups, {"groupb": b} | columns(groups) | crossed),
        "between": (part, {"groupb": at(part, "group", "b")}),
        "six": (six, {"factor(group)b": at(six, "group", "b")}),
    }


@pytest.mark.parametrize("case", ["square", "missing", "groups", "between", "six"])
def test_mixed_model_with_missing_laps_and_groups(case):
    """lme4's estimates and errors to 1e-4; lmerTest's Kenward-Roger errors, df and p."""
    frame, columns = mixed_cases()[case]
    matrix = np.column_stack([np.ones(len(frame)), *columns.values()])
    fit = fit_random_intercept(np.log(frame["lap_time_s"]), matrix, frame["participant"])
    assert fit.between == pytest.approx(MIXED[f"{case}.between"], abs=1e-4)
    assert fit.within == pytest.approx(MIXED[f"{case}.within"], abs=1e-4)
    for i, name in enumerate(columns, start=1):
        weights = np.eye(matrix.shape[1])[i]
        estimate, error, df = fit.contrast(weights)
        assert estimate == pytest.approx(MIXED[f"{case}.{name}.estimate"], abs=1e-4)
        plain = np.sqrt(fit.covariance[i, i])
        assert plain == pytest.approx(MIXED[f"{case}.{name}.se"], abs=1e-4)
        assert error == pytest.approx(MIXED[f"{case}.{name}.se_kr"], abs=1e-4)
        assert df == pytest.approx(MIXED[f"{case}.{name}.df"], rel=1e-3)
        p = 2 * scipy_stats.t.sf(abs(estimate / error), df)
        assert p == pytest.approx(MIXED[f"{case}.{name}.p"], abs=1e-3)


def test_lap_times_with_their_places():
    """lme4 with the place as a factor, seven laps missing: the public function's result."""
    laps = pd.read_csv(R / "laps_square.csv")
    for found in lap_time_model(laps, "limited", np.random.default_rng(0)):
        name = f"square.condition{found.name.split()[0]}"
        assert found.estimate == pytest.approx(MIXED[f"{name}.estimate"], abs=1e-4)
        assert found.p == pytest.approx(MIXED[f"{name}.p"], abs=1e-3)
        assert "condition + place" in found.method


@pytest.mark.parametrize("package", ["polr", "clm"])
def test_proportional_odds(item, package):
    """MASS::polr and ordinal::clm."""
    found = proportional_odds(item["condition"], item["reference"], np.random.default_rng(0))
    assert found.estimate == r_optimum(package)


def test_cronbachs_alpha():
    """Written out in R, with Feldt's interval."""
    found = cronbach_alpha(pd.read_csv(R / "scale.csv"))
    assert found.estimate == r("alpha")
    assert found.low == r("alpha.low")
    assert found.high == r("alpha.high")
