"""Every test and estimate against R, on committed data (tests/data/r)."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy import stats as scipy_stats

from analysis.frames import study_frames
from analysis.groups import group_model
from analysis.stats.carry_over import carry_over
from analysis.stats.cronbach_alpha import cronbach_alpha
from analysis.stats.effect_size import cohen_dz, rank_biserial
from analysis.stats.holm import holm
from analysis.stats.kolmogorov_smirnov import asymptotic_p, two_sample_ks
from analysis.stats.mean_difference import mean_difference
from analysis.stats.mixed_model import lap_time_model
from analysis.stats.proportional_odds import proportional_odds
from analysis.stats.random_intercept import fit_random_intercept
from analysis.stats.rank_sum import rank_sum
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


def test_mixed_model_in_turned_orders():
    """lme4::lmer with a straight line through the places, two laps missing."""
    laps = pd.read_csv(R / "laps_turned.csv")
    line = (laps["lap"] - laps["lap"].mean()).to_numpy()
    names = ("baseline", "human", "model")
    matrix = np.column_stack([np.ones(len(laps)), *(at(laps, "condition", n) for n in names), line])
    fit = fit_random_intercept(np.log(laps["lap_time_s"]), matrix, laps["participant"])
    for i, name in enumerate(names, start=1):
        assert fit.effects[i] == r_optimum(f"lmer.turned.{name}")
        assert np.sqrt(fit.covariance[i, i]) == r_optimum(f"lmer.turned.{name}.se")


def test_spreads_of_the_mixed_model():
    """lme4's standard deviations between people and of the residual, in the fixed order."""
    laps = pd.read_csv(R / "laps.csv")
    names = ("baseline", "human", "model")
    matrix = np.column_stack([np.ones(len(laps)), *(at(laps, "condition", n) for n in names)])
    fit = fit_random_intercept(np.log(laps["lap_time_s"]), matrix, laps["participant"])
    assert fit.between == r_optimum("lmer.sd_participant")
    assert fit.within == r_optimum("lmer.sd_residual")


MIXED = pd.read_csv(R / "mixed_model.csv", index_col="name")["value"]
GROUPS = pd.read_csv(R / "groups.csv", index_col="name")["value"]


def at(frame, column, value):
    """Return 1 where a column has a value, 0 elsewhere."""
    return (frame[column] == value).to_numpy(dtype=float)


def mixed_cases():
    """Return fixtures with missing laps and groups: data, columns of the matrix by R's names."""
    square = pd.read_csv(R / "laps_square.csv")
    groups = pd.read_csv(R / "laps_groups.csv")
    part = groups[groups["condition"] != "baseline"]
    six = pd.read_csv(R / "laps_six_people.csv")
    conditions = ("baseline", "human", "model")

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


def close_to_r(ending, value):
    """Return R's value with the tolerance of its kind: degrees of freedom are large numbers."""
    if ending == "df":
        return pytest.approx(value, rel=1e-3)
    return pytest.approx(value, abs=1e-3 if ending == "p" else 1e-4)


@pytest.mark.parametrize("case", ["square", "missing", "groups", "between", "six"])
def test_mixed_model_with_missing_laps_and_groups(case):
    """lme4's estimates and errors to 1e-4; lmerTest's Kenward-Roger errors, df and p: each row."""
    frame, columns = mixed_cases()[case]
    matrix = np.column_stack([np.ones(len(frame)), *columns.values()])
    fit = fit_random_intercept(np.log(frame["lap_time_s"]), matrix, frame["participant"])
    ours = {f"{case}.between": fit.between, f"{case}.within": fit.within}
    for i, name in enumerate(["(Intercept)", *columns]):
        estimate, error, df = fit.contrast(np.eye(matrix.shape[1])[i])
        ours |= {
            f"{case}.{name}.estimate": estimate,
            f"{case}.{name}.se": np.sqrt(fit.covariance[i, i]),
            f"{case}.{name}.se_kr": error,
            f"{case}.{name}.df": df,
            f"{case}.{name}.p": 2 * scipy_stats.t.sf(abs(estimate / error), df),
        }
    theirs = {name: value for name, value in MIXED.items() if name.startswith(f"{case}.")}
    assert set(ours) == set(theirs)
    for name, value in theirs.items():
        assert ours[name] == close_to_r(name.rpartition(".")[2], value), name


def test_lap_times_with_their_places():
    """lme4 with the place as a factor, seven laps missing: the public function's result."""
    laps = pd.read_csv(R / "laps_square.csv")
    for found in lap_time_model(laps, "limited", np.random.default_rng(0)):
        name = f"square.condition{found.name.split()[0]}"
        assert found.estimate == pytest.approx(MIXED[f"{name}.estimate"], abs=1e-4)
        error = found.estimate / found.statistic
        assert error == pytest.approx(MIXED[f"{name}.se_kr"], abs=1e-4)
        assert found.p == pytest.approx(MIXED[f"{name}.p"], abs=1e-3)
        assert "condition + place" in found.method


def test_groups_as_a_report_compares_them(make_study):
    """Group x condition by the report's own function is lmerTest's: errors, interval, p."""
    laps = pd.read_csv(R / "laps_groups.csv")
    laps["condition"] = laps["condition"].replace(
        {"human": "human-assisted", "model": "model-assisted"}
    )
    laps["log_time"] = np.log(laps["lap_time_s"])
    found = group_model(study_frames(make_study(participants=2)), laps, "b", "a")
    names = ["groupb"] + [f"groupb:condition{c}" for c in ("baseline", "human", "model")]
    assert [f.name.split()[0] for f in found[1:]] == [
        "baseline",
        "human-assisted",
        "model-assisted",
    ]
    for ours, name in zip(found, names, strict=True):
        estimate, error, df = (
            MIXED[f"groups.{name}.{kind}"] for kind in ("estimate", "se_kr", "df")
        )
        half = scipy_stats.t.ppf(0.975, df) * error
        assert ours.estimate == pytest.approx(estimate, abs=1e-4)
        assert ours.estimate / ours.statistic == pytest.approx(error, abs=1e-4)
        assert (ours.low, ours.high) == pytest.approx((estimate - half, estimate + half), abs=5e-4)
        assert ours.p == pytest.approx(MIXED[f"groups.{name}.p"], abs=1e-3)


@pytest.mark.parametrize("case", ["slower", "change"])
def test_rank_sum_of_two_groups(case):
    """wilcox.test(exact, conf.int) of people's log times, and of their log ratios."""
    laps = pd.read_csv(R / "laps_groups.csv")
    laps["log_time"] = np.log(laps["lap_time_s"])
    wide = laps.pivot_table(index=["participant", "group"], columns="condition", values="log_time")
    b = wide.index.get_level_values("group") == "b"
    values = {"slower": wide["limited"] + 0.3 * b, "change": wide["model"] - wide["limited"]}[case]
    found = rank_sum(values[b], values[~b])
    for name in ("statistic", "p", "estimate", "low", "high"):
        wanted = pytest.approx(GROUPS[f"rank_sum.{case}.{name}"], rel=1e-6, abs=1e-6)
        assert getattr(found, name) == wanted


def test_rank_sum_with_ties(item):
    """Every choice of who is in the group, enumerated in R."""
    few = item.iloc[:14]
    high = few["reference"] > 2
    found = rank_sum(few["condition"][high], few["condition"][~high])
    assert found.p == pytest.approx(GROUPS["rank_sum.ties.p"], rel=1e-6)


def test_carry_over_in_a_square():
    """The condition of the lap before in lmerTest, seven laps missing."""
    found = carry_over(pd.read_csv(R / "laps_square.csv"), "limited")
    assert {f.name.split()[1] for f in found} == {"baseline", "human", "model"}
    for ours in found:
        name = f"carry_over.{ours.name.split()[1]}"
        assert ours.estimate == pytest.approx(GROUPS[f"{name}.estimate"], abs=1e-4)
        error = ours.estimate / ours.statistic
        assert error == pytest.approx(GROUPS[f"{name}.se_kr"], abs=1e-4)
        assert ours.p == pytest.approx(GROUPS[f"{name}.p"], abs=1e-3)


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
