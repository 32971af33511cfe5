"""Places: balance, what is done about practice, and taking their effect off."""

import numpy as np
import pandas as pd
import pytest

from analysis.lap_time_test import compare_laps
from analysis.place import imbalance, practice_of, with_place, without_place
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
@pytest.mark.parametrize("practice", [0.0, 0.08])
def test_a_true_null_hypothesis_is_rejected_at_its_level(practice):
    """600 cohorts of twelve in a square: between 3% and 7% at 5%, with practice and without."""
    rng = np.random.default_rng(1)
    tests = [
        compare_laps(laps(list(SQUARE) * 3, practice, seed=s), "d", "a", "complete pairs", rng)
        for s in range(600)
    ]
    assert 0.03 < np.mean([t.test.p <= 0.05 for t in tests]) < 0.07
