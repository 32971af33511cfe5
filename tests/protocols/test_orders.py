"""Orders: squares, rules, and that a model must have been taught."""

from collections import Counter
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocols.balance import balance_in_words, orders_of
from protocols.files.errors import InputError
from protocols.load import load_protocol
from protocols.order import group_of, in_words, laps_of, of_participant, places
from protocols.orders import Orders, designed_orders, williams_row

CONDITIONS = tuple("abcdefgh")


def changed(tmp_path, addition, name="four-lap"):
    """Return a shipped protocol with lines added at its end, from a file."""
    from protocols.shipped import shipped_text

    path = tmp_path / "mine.yaml"
    path.write_text(f"{shipped_text(name)}\n{addition}\n", encoding="utf-8")
    return load_protocol(str(path))


@given(st.integers(2, 8))
def test_a_williams_square_balances_place_and_carry_over(k):
    """Every condition has every place, and follows every other one, equally often."""
    orders = designed_orders(Orders(use="williams"), CONDITIONS[:k])
    assert len(orders) == (k if k % 2 == 0 else 2 * k)
    at = Counter((place, c) for order in orders for place, c in enumerate(order))
    follows = Counter(pair for order in orders for pair in pairwise(order))
    assert len(at) == k * k
    assert len(set(at.values())) == 1
    assert len(follows) == k * (k - 1)
    assert len(set(follows.values())) == 1
    assert sorted(williams_row(k)) == list(range(k))


@pytest.mark.parametrize(("use", "wanted"), [("all", 12), ("random", 12), ("williams", 2)])
def test_orders_that_cannot_be_taught_are_not_driven(tmp_path, use, wanted):
    """Of 24 orders of the four-lap study the model's own teaching allows 12; of a square's 4, 2."""
    protocol = changed(tmp_path, f"orders: {use}")
    assert len(orders_of(protocol)) == wanted
    for order in orders_of(protocol):
        assert order.index("human-assisted") < order.index("model-assisted")
    assert any("place is not balanced" in said for said in balance_in_words(protocol))


def test_a_borrowed_model_frees_the_square():
    """In the shipped balanced study all four orders can be driven."""
    protocol = load_protocol("four-lap-balanced")
    assert len(orders_of(protocol)) == 4
    driven = Counter(in_words(laps_of(protocol, n, 7)) for n in range(1, 13))
    assert set(driven.values()) == {3}


def test_practice_stays_and_questions_move_with_their_lap(tmp_path):
    """The first lap is practice in every order; eleven items follow each assisted lap."""
    protocol = changed(tmp_path, "orders: all")
    for number in range(1, 25):
        laps = laps_of(protocol, number, 3)
        assert laps[0].condition == "familiarisation"
        assert places(laps) == (None, 1, 2, 3, 4)
        assert sorted(lap.condition for lap in laps) == sorted(
            lap.condition for lap in protocol.laps
        )
        for lap in laps:
            assert lap in protocol.laps


def test_rules_of_before_are_kept(tmp_path):
    """With one more rule 12 legal orders become fewer, and each keeps it."""
    rule = "orders: {use: all, before: [{first: baseline, then: limited}]}"
    orders = orders_of(changed(tmp_path, rule))
    assert len(orders) == 6
    assert all(o.index("baseline") < o.index("limited") for o in orders)


def test_an_order_is_a_function_of_seed_and_number():
    """The same participant gets the same order whoever else takes part; seeds differ."""
    protocol = load_protocol("four-lap-balanced")
    fewer = protocol.model_copy(
        update={"cohort": protocol.cohort.model_copy(update={"participants": 3})}
    )
    assert laps_of(protocol, 3, 0) == laps_of(fewer, 3, 0)
    drawn = {tuple(in_words(laps_of(protocol, n, s)) for n in range(1, 5)) for s in range(8)}
    assert len(drawn) > 1
    registered = protocol.model_copy(update={"registration": "ab" * 32})
    orders = [laps_of(registered, n, 0) for n in range(1, 5)]
    assert orders == [laps_of(registered, n, 99) for n in range(1, 5)]


GROUPS = """
groups:
  usual: {ratio: 2}
  eager:
    model: {parameters: {threshold: 0.3}}
    conditions:
      model-assisted: {limitation: {right_turn_rad_s: 0.15}, assistant: model, arbitration: augment}
orders: latin
"""


def test_groups_have_their_ratio_after_every_block_and_orders_within(tmp_path):
    """Two to one in each block of three; each group goes through all its orders."""
    protocol = changed(tmp_path, GROUPS, "four-lap")
    groups = [group_of(protocol, n, 5) for n in range(1, 31)]
    for block in range(10):
        assert Counter(groups[3 * block : 3 * block + 3]) == {"usual": 2, "eager": 1}
    own = of_participant(protocol, groups.index("eager") + 1, 5)
    assert own.conditions["model-assisted"].arbitration == "augment"
    assert own.model.parameters.threshold == 0.3
    assert of_participant(protocol, groups.index("usual") + 1, 5) == protocol
    legal = len(orders_of(protocol))
    for group in ("usual", "eager"):
        mine = [n for n in range(1, 31) if groups[n - 1] == group][:legal]
        assert len({in_words(laps_of(protocol, n, 5)) for n in mine}) == legal


@pytest.mark.parametrize(
    ("addition", "message"),
    [
        ("orders: {use: williams, over: [limited]}", "no williams orders of 1 condition"),
        ("orders: {use: williams, over: [limitd]}", "not a condition of a lap to analyse"),
        ("orders: [[baseline, limited, model-assisted, human-assisted]]", "has learnt anything"),
        ("orders: [[baseline, limited]]", "each condition once"),
        ("orders: {use: all, before: [{first: model-assisted, then: human-assisted}]}",
         "no order of all can be driven"),
        ("orders: {use: fixed, over: [limited]}", "a fixed order has no over"),
        ("groups: {one: {}}", "1 group is no factor"),
        ("groups: {one: {}, two: {conditions: {lap: {}}}}", "not a condition of this protocol"),
        ("groups: {one: {}, two: {conditions: {human-assisted: {assistant: demonstrator}}}}",
         "learnt nothing yet in this group"),
        ("models: {own: {from: pilot}}", "own is the participant's model"),
        ("models: {other: {from: file}}", "a path is needed"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_one_line(tmp_path, addition, message):
    """One line, which field, and what is allowed."""
    with pytest.raises(InputError, match=message) as error:
        changed(tmp_path, addition)
    assert "\n" not in str(error.value)
