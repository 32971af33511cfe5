"""Places: balance, what is done about practice, and taking their effect off."""

import numpy as np
import pandas as pd
import pytest

from analysis.lap_time_test import compare_laps
from analysis.place import (
    imbalance,
    less_places,
    practice_of,
    restored,
    with_place,
    without_place,
)
from analysis.power.adjusted import adjusted, log_differences
from analysis.power.pool import Pool
from analysis.power.vectorised import signed_rank_p
from analysis.stats.signed_rank import signed_rank
from protocols.declared import Comparison
from protocols.orders import Orders, designed_orders

CONDITIONS = ("a", "b", "c", "d")
SQUARE = designed_orders(Orders(use="williams"), CONDITIONS)


def laps(orders, practice=0.08, noise=0.1, seed=0):
    """Return laps of people in given orders; practice follows a power law."""
    rng = np.random.default_rng(seed)
    rows = []
    for i, order in enumerate(orders):
        own = rng.normal(4, 0.3)
        for place, c in enumerate(order, start=1):
            log_time = own + rng.normal(0, noise) - practice * np.log2(place)
            rows.append((f"P{i:02d}", c, place, np.exp(log_time)))
    return pd.DataFrame(rows, columns=["participant", "condition", "place", "lap_time_s"])


@pytest.mark.parametrize(
    ("orders", "wanted"),
    [
        ([CONDITIONS] * 12, "confounded"),
        ([CONDITIONS] * 11 + [CONDITIONS[::-1]], "confounded"),
        ([CONDITIONS] * 39 + [CONDITIONS[::-1]], "confounded"),
        (list(SQUARE) * 3, "balanced"),
        ((list(SQUARE) * 3)[:10], "balanced"),
        ([CONDITIONS] * 4 + list(SQUARE) * 2, "adjusted"),
    ],
)
def test_practice_is_told_apart_only_where_places_are_even(orders, wanted):
    """One reversed order among twelve, or forty, tells nothing; a square does, two lost or not."""
    assert practice_of(laps(orders), "d", "a") == wanted


def test_what_is_not_driven_has_no_balance():
    """A condition without laps is confounded with everything."""
    table = laps(list(SQUARE))
    assert practice_of(table, "d", "e") == "confounded"
    assert imbalance(table[table["condition"] != "d"], "d", "a") == 1.0


def test_in_a_square_any_practice_is_taken_off_exactly():
    """Without noise, what is left is the person: whatever the shape of practice is."""
    table = laps(list(SQUARE) * 3, practice=0.2, noise=0.0)
    left = without_place(table, np.log(table["lap_time_s"]))
    spread = left.groupby(table["participant"]).std()
    assert spread.max() < 1e-9


def test_lost_people_leave_the_spread_that_places_would_take():
    """In a whole square nothing is restored; with two lost, the test is of a wider spread."""
    whole, lost = laps(list(SQUARE) * 3), laps((list(SQUARE) * 3)[:10])
    assert less_places(whole) == (33, 3)
    assert less_places(lost) == (27, 3)
    found = []
    for table in (whole, lost):
        left = table.assign(value=without_place(table, np.log(table["lap_time_s"])))
        wide = left.pivot_table(index="participant", columns="condition", values="value")
        d = (wide["d"] - wide["a"]).to_numpy()
        tested = compare_laps(table, "d", "a", "complete pairs", np.random.default_rng(0)).test
        found.append((signed_rank(d), signed_rank(restored(d, *less_places(table))), tested))
    assert found[0][2].low == pytest.approx(found[0][0].low)
    assert found[1][2].low == pytest.approx(found[1][1].low)
    assert found[1][1].high - found[1][1].low > found[1][0].high - found[1][0].low


def test_in_a_fixed_order_nothing_is_taken_off():
    """Places that follow from conditions cannot be told from them."""
    table = laps([CONDITIONS] * 8)
    log_time = np.log(table["lap_time_s"])
    assert without_place(table, log_time).equals(log_time)


def test_practice_moves_no_test_in_a_square():
    """The same people with and without practice: the same estimate, interval and p."""
    rng = np.random.default_rng(0)
    found = [
        compare_laps(laps(list(SQUARE) * 3, practice=p), "d", "a", "complete pairs", rng).test
        for p in (0.0, 0.3)
    ]
    for name in ("estimate", "low", "high", "p"):
        assert getattr(found[0], name) == pytest.approx(getattr(found[1], name))


def test_place_counts_analysed_laps_and_keeps_what_was_recorded():
    """Laps 1, 3 and 4 are places 1, 2 and 3, unless the record says otherwise."""
    table = pd.DataFrame({"participant": ["P"] * 3, "lap": [1, 3, 4]})
    assert list(with_place(table)["place"]) == [1, 2, 3]
    assert list(with_place(table.assign(place=[2.0, np.nan, 4.0]))["place"]) == [2, 2, 4]


@pytest.mark.slow
@pytest.mark.parametrize("people", [8, 10, 12])
def test_a_true_null_hypothesis_is_rejected_at_its_level(people):
    """8,000 cohorts in a square, practice 8% a lap: between 3% and 6% at 5%, two lost or nobody.

    By the computation of power, which tests many studies at once as the report does.
    """
    orders = (list(SQUARE) * 3)[:people]
    places = np.array([[order.index(c) + 1.0 for c in CONDITIONS] for order in orders])
    rng, cohorts = np.random.default_rng([2026, people]), 8000
    logs = rng.normal(4, 0.3, (cohorts, people, 1)) + rng.normal(0, 0.12, (cohorts, people, 4))
    logs -= 0.08 * places
    said = np.tile([" > ".join(order) for order in orders], cohorts)
    every, nobody = np.tile(places, (cohorts, 1)), np.full(len(said), "")
    pool = Pool(CONDITIONS, logs.reshape(-1, 4), every, {}, {}, said, nobody)
    drawn = np.arange(len(said)).reshape(cohorts, people)
    analysis = Comparison(name="d faster", condition="d", reference="a")
    p = signed_rank_p(log_differences(pool, drawn, adjusted(pool, drawn), analysis))
    assert 0.03 < np.mean(p <= 0.05) < 0.06
