"""The allocation of living people balances over usable sessions."""

from collections import Counter

from hypothesis import given
from hypothesis import strategies as st

from protocols.allocation import Enrolled, next_allocation
from protocols.load import load_protocol
from protocols.order import in_words, laps_of


@given(st.lists(st.booleans(), min_size=1, max_size=40))
def test_usable_sessions_hold_the_first_slots_once_each(stays):
    """Whoever leaves, those who stay have slots 1 to n, none twice."""
    enrolled = []
    for i, usable in enumerate(stays, start=1):
        slot = next_allocation(enrolled).slot
        enrolled.append(Enrolled(f"P{i:04d}", slot, "usable" if usable else "withdrawn"))
    held = sorted(e.slot for e in enrolled if e.state == "usable")
    assert held == list(range(1, len(held) + 1))


def test_orders_are_balanced_over_those_who_stayed():
    """Every third participant withdraws: twelve usable sessions have each order three times."""
    protocol = load_protocol("four-lap-balanced")
    enrolled = []
    while sum(e.state == "usable" for e in enrolled) < 12:
        slot = next_allocation(enrolled).slot
        state = "withdrawn" if len(enrolled) % 3 == 2 else "usable"
        enrolled.append(Enrolled(f"P{len(enrolled) + 1:04d}", slot, state))
    orders = Counter(
        in_words(laps_of(protocol, e.slot, 4)) for e in enrolled if e.state == "usable"
    )
    assert set(orders.values()) == {3}


def test_two_who_are_under_way_have_different_slots():
    """A slot is given again only when its holder's session cannot be used."""
    first = Enrolled("P0001", next_allocation([]).slot, "under way")
    assert next_allocation([first]).slot == 2
    gone = Enrolled("P0001", 1, "excluded")
    found = next_allocation([gone, Enrolled("P0002", 2, "under way")])
    assert (found.slot, found.reason) == (1, "given again: P0001 was excluded")
