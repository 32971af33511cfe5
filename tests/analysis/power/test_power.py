"""Power by drawing: against analytic power, and the pool's own error."""

import json
import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from analysis.attainable import least_n
from analysis.frames import study_frames
from analysis.lap_time_test import compare_laps
from analysis.power.adjusted import adjusted, log_differences
from analysis.power.assumptions import stated_effects
from analysis.power.draws import draw_studies, pool_error
from analysis.power.page import PowerStudy, power_json, write_power
from analysis.power.pool import Pool, planned_practice, pool_of
from analysis.power.power import power_rows, smallest_n
from analysis.power.vectorised import (
    paired_t_p,
    pseudomedians,
    rank_sum_rows,
    signed_rank_p,
    tost_p,
)
from analysis.stats.rank_sum import rank_sum
from analysis.stats.signed_rank import signed_rank
from analysis.stats.tost import paired_tost
from protocols.declared import Comparison
from protocols.files.errors import InputError
from protocols.groups import Group
from protocols.load import load_protocol
from protocols.order import in_words, laps_of

DZ = 0.6
SIZES = (6, 8, 12, 20, 30)
STUDIES = 4000


def normal_pool(people=400, seed=0):
    """Return standard normal differences whose mean and spread are exactly 0 and 1."""
    d = np.random.default_rng(seed).normal(size=people)
    return (d - d.mean()) / d.std()


def drawn_rows(d, n, seed=1):
    """Return studies of n people drawn from a pool of differences."""
    keys = np.random.default_rng(seed).random((STUDIES, len(d)))
    at = np.argsort(keys, axis=1)[:, :n]
    return at, d[at]


def within_two_errors(rejected, at, wanted, size=400):
    """Tell whether a power agrees, by the error of the drawing and of the pool together."""
    error = math.hypot(math.sqrt(wanted * (1 - wanted) / STUDIES), pool_error(at, rejected, size))
    return abs(rejected.mean() - wanted) < 2 * error


@pytest.mark.parametrize("n", SIZES)
def test_power_of_the_paired_t_is_the_analytic_one(n):
    """Noncentral t with d_z 0.6: drawing without replacement from 400 people agrees."""
    at, rows = drawn_rows(normal_pool() + DZ, n)
    limit = stats.t.ppf(0.975, n - 1)
    shift = DZ * math.sqrt(n)
    analytic = stats.nct.sf(limit, n - 1, shift) + stats.nct.cdf(-limit, n - 1, shift)
    assert within_two_errors(paired_t_p(rows) < 0.05, at, analytic)


@pytest.mark.parametrize("n", SIZES)
def test_power_of_equivalence_is_the_exact_one(n):
    """TOST, no difference, margin 0.9 sd: against the integral over the spread (Owen's Q)."""
    at, rows = drawn_rows(normal_pool(seed=3), n)
    margin, df = 0.9, n - 1
    limit = stats.t.ppf(0.95, df)
    spread = np.sqrt(np.linspace(1e-9, stats.chi2.ppf(1 - 1e-10, df), 20001) / df)
    reach = np.clip(margin * math.sqrt(n) - limit * spread, 0, None)
    density = stats.chi2.pdf(spread**2 * df, df)
    inside = stats.norm.cdf(reach) - stats.norm.cdf(-reach)
    exact = np.trapezoid(inside * density, spread**2 * df)
    assert within_two_errors(tost_p(rows, margin) < 0.05, at, exact)


def test_the_vectorised_tests_are_the_declared_ones():
    """Row by row the same p, estimate and interval as the report's, ties and gaps included."""
    rng = np.random.default_rng(4)
    rows = rng.normal(0.3, 1, (30, 9))
    rows[3, 2] = rows[4, 1] = np.nan
    rows[5] = np.round(rows[5])
    estimates, widths = pseudomedians(rows)
    for i, row in enumerate(rows):
        found = signed_rank(row)
        assert signed_rank_p(rows)[i] == pytest.approx(found.p)
        assert tost_p(rows, 2.0)[i] == pytest.approx(paired_tost(row, 2.0).p)
        assert estimates[i] == pytest.approx(found.estimate)
        assert widths[i] == pytest.approx(found.high - found.low)


def pool_of_laps(orders, effect=-0.12, practice=0.08, people=400, seed=0):
    """Return a pool of a reference and a condition, with practice, in given orders."""
    rng = np.random.default_rng(seed)
    order = np.array([orders[i % len(orders)] for i in range(people)])
    place = np.array([[o.split(" > ").index(c) + 1 for c in "ab"] for o in order], dtype=float)
    times = rng.normal(4, 0.3, (people, 1)) + rng.normal(0, 0.12, (people, 2))
    logs = times + np.array([0.0, effect]) - practice * place
    seconds = np.exp(logs)
    return Pool(("a", "b"), logs, place, {"b faster": seconds[:, 1] - seconds[:, 0]},
                {"b faster": float(seconds[:, 0].mean())}, order, np.full(people, ""))  # fmt: skip


def test_places_are_taken_off_where_orders_are_balanced():
    """Half a > b, half b > a: what is left does not depend on practice."""
    with_practice = pool_of_laps(["a > b", "b > a"])
    without = pool_of_laps(["a > b", "b > a"], practice=0.0)
    drawn = draw_studies(
        with_practice, [("", "a > b"), ("", "b > a")] * 6, 50, np.random.default_rng(0)
    )
    differences = [np.diff(adjusted(p, drawn), axis=2) for p in (with_practice, without)]
    assert differences[0] == pytest.approx(differences[1])
    for study in drawn:
        assert sorted(with_practice.orders[study]) == ["a > b"] * 6 + ["b > a"] * 6
        assert len(set(study)) == 12


def test_many_studies_at_once_are_tested_as_the_report_does():
    """In a square, with a lap missing: the report's p of a study is the power computation's."""
    pool = pool_of_laps(["a > b", "b > a"], people=40)
    pool.log_times[3, 1] = pool.places[3, 1] = np.nan
    drawn = draw_studies(pool, [("", "a > b"), ("", "b > a")] * 8, 5, np.random.default_rng(2))
    drawn[0, 0] = 3
    analysis = Comparison(name="b faster", condition="b", reference="a")
    p = signed_rank_p(log_differences(pool, drawn, adjusted(pool, drawn), analysis))
    for study, found in zip(drawn, p, strict=True):
        rows = [
            (f"P{i:02d}", c, pool.places[who, at], np.exp(pool.log_times[who, at]))
            for i, who in enumerate(study)
            for at, c in enumerate("ab")
        ]
        names = ["participant", "condition", "place", "lap_time_s"]
        table = pd.DataFrame(rows, columns=names).dropna()
        tested = compare_laps(table, "b", "a", "complete pairs", np.random.default_rng(0))
        assert tested.practice == "balanced"
        assert tested.test.p == pytest.approx(found)


def test_a_square_is_planned_without_a_caution():
    """Balanced as planned in a Williams square, confounded in a fixed order."""
    for name, practice in (("four-lap-balanced", "balanced"), ("four-lap", "confounded")):
        protocol = load_protocol(name)
        assert planned_practice(protocol, protocol.analyses[0], 12) == practice


def test_a_stated_effect_takes_only_the_shape_from_the_pool(study):
    """Stated, the pool's own effect does not matter; each row says its source."""
    protocol = load_protocol("four-lap")
    analysis = Comparison(name="b faster", condition="b", reference="a", kind="confirmatory")
    protocol = protocol.model_copy(update={"analyses": (analysis,)})
    pools = [pool_of_laps(["a > b"], effect=e, practice=0.0) for e in (-0.5, 0.2)]
    stated = [
        power_rows(protocol, p, (12,), {"b faster": -0.12}, seed=0, studies=300) for p in pools
    ]
    assert stated[0][0].power == stated[1][0].power
    assert stated[0][0].source == "stated"
    (own,) = power_rows(protocol, pools[0], (12,), {}, seed=0, studies=300)
    assert own.source == "cohort"
    assert own.power > stated[0][0].power
    assert least_n(protocol, analysis) == 6
    assert power_rows(protocol, pools[0], (5,), {}, seed=0, studies=50)[0].power == 0


def test_many_groups_at_once_are_compared_as_the_report_does():
    """Row by row the same p, shift and width as ``rank_sum``; ties and missing people included."""
    rng = np.random.default_rng(5)
    first, second = rng.normal(0.5, 1, (12, 7)), rng.normal(0, 1, (12, 6))
    first[2, 3] = second[3, 0] = np.nan
    first[4, :2] = second[4, 0]
    p, shift, width = rank_sum_rows(first, second)
    for i, (a, b) in enumerate(zip(first, second, strict=True)):
        found = rank_sum(a, b)
        assert p[i] == pytest.approx(found.p)
        assert shift[i] == pytest.approx(found.estimate)
        assert width[i] == pytest.approx(found.high - found.low)


def test_power_between_groups_grows_with_the_stated_effect():
    """No effect: about 5%; the larger it is stated, the more power; the pool's own is ignored."""
    protocol = load_protocol("four-lap")
    between = Comparison(name="more", condition="b", reference="a", groups=("x", "y"))
    changes = {"analyses": (between,), "groups": {"x": Group(), "y": Group(ratio=2)}}
    protocol = protocol.model_copy(update=changes)
    pool = pool_of_laps(["a > b"], practice=0.0)
    groups = np.array(["x", "y", "y"] * 134)[: pool.size]
    change = np.diff(pool.log_times, axis=1)[:, 0]
    pool = replace(pool, groups=groups, differences={"more": change})
    found = [power_rows(protocol, pool, (24,), {"more": e}, seed=0)[0].power for e in (0, 0.1, 0.3)]
    assert 0.02 < found[0] < 0.07
    assert found[0] < found[1] < found[2]
    assert least_n(protocol, between) == 9  # 3 and 6: 2 of 84


def test_a_larger_pool_has_a_smaller_error():
    """The jackknife's error falls with the pool, and is about what other pools show."""
    found = []
    for people in (100, 1600):
        at, rows = drawn_rows(np.random.default_rng(7).normal(DZ, 1, people), 12)
        found.append(pool_error(at, paired_t_p(rows) < 0.05, people))
    assert found[1] < found[0]
    powers = []
    for seed in range(40):
        d = np.random.default_rng(100 + seed).normal(DZ, 1, 100)
        powers.append((paired_t_p(drawn_rows(d, 12)[1]) < 0.05).mean())
    assert found[0] == pytest.approx(np.std(powers), rel=0.5)


def test_a_study_is_a_pool_and_its_page_says_so(study, tmp_path):
    """From a recorded study to rows, page and JSON; a stated effect is parsed in percent and s."""
    frames = study_frames(study)
    pool = pool_of(frames, study.protocol.analyses)
    assert set(pool.orders) == {in_words(laps_of(study.protocol, 1, 0))}
    effects = stated_effects(["the model helps: -10%"], study.protocol, pool)
    assert effects["the model helps"] == pytest.approx(math.log(0.9))
    rows = power_rows(study.protocol, pool, (2, 3), effects, seed=0, studies=40)
    page = write_power(tmp_path, PowerStudy(study.protocol, rows, pool.size, True, 0.8))
    text = page.read_text(encoding="utf-8")
    assert "To paste" in text
    assert "gives no verdict on the condition" in text  # four-lap has one fixed order
    first = json.loads(power_json(rows))[0]
    assert set(first) == {"analysis", "n", "power", "mc_error", "pool_error", "source"}
    assert smallest_n(rows, "the model helps", 0.8) is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("the modl helps: -10%", "not a declared analysis"),
        ("the model helps: fast", "states no effect"),
        ("the model helps: -120%", "leaves no time"),
        ("Q7 after model and demonstrator: 10%", "states no effect"),
    ],
)
def test_what_states_no_effect_is_refused(study, text, message):
    """One line: which text, and what is allowed."""
    pool = pool_of(study_frames(study), study.protocol.analyses)
    with pytest.raises(InputError, match=message):
        stated_effects([text], study.protocol, pool)
