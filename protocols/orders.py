"""Orders of conditions: which ones a protocol's design has, and which of them can be driven."""

import itertools
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

from pydantic import Field, model_validator

from protocols.condition import Condition
from protocols.files.fault import Fault, Location
from protocols.files.file_model import FileModel, Name
from protocols.files.suggestion import allowed
from protocols.laps import PlannedLap

OrderKind = Literal["fixed", "williams", "latin", "all", "random", "list"]

MOST = 6
"""Conditions of which all orders are taken at most: 720 orders."""

Order = tuple[str, ...]
"""Conditions in the order in which they are driven."""


class Before(FileModel):
    """A rule: one condition is driven before another one.

    Attributes
    ----------
    first, then
        Names of two conditions: the first one is driven before the other.
    """

    first: Name
    then: Name


class Orders(FileModel):
    """In which orders the analysed conditions are driven; in a file also just the name of a design.

    Attributes
    ----------
    use
        ``fixed``: as the laps stand. ``williams``: a square in which every condition has every
        place, and follows every other one, equally often. ``latin``: every place equally often.
        ``all``: every order, one after the other. ``random``: every order, shuffled in blocks.
        ``list``: the orders given.
    over
        The conditions that change places; empty for all that are analysed. Practice laps and the
        other conditions stay where they are.
    before
        Rules; orders that break one are not driven. That a model must have been taught is a rule
        of its own.
    orders
        Of ``list``: each names every condition of ``over`` once.
    """

    use: OrderKind = "fixed"
    over: tuple[Name, ...] = ()
    before: tuple[Before, ...] = ()
    orders: tuple[tuple[Name, ...], ...] = Field(default=(), alias="list")

    @model_validator(mode="before")
    @classmethod
    def _in_short(cls, given: Any) -> Any:
        if isinstance(given, str):
            return {"use": given}
        if isinstance(given, list | tuple):
            return {"use": "list", "list": _tuples(given)}
        if isinstance(given, dict):  # what a validator has looked at counts as Python, not as JSON
            return {name: _tuples(value) for name, value in given.items()}
        return given


def _tuples(value: Any) -> Any:
    """Return lists as tuples, at every depth."""
    return tuple(map(_tuples, value)) if isinstance(value, list | tuple) else value


def moved_conditions(orders: Orders, laps: Sequence[PlannedLap]) -> Order:
    """Return the conditions that change places, in the order of the laps.

    Parameters
    ----------
    orders
        The design.
    laps
        As the protocol has them.

    Examples
    --------
    >>> laps = [PlannedLap(condition="a", practice=True), *(PlannedLap(condition=c) for c in "abc")]
    >>> moved_conditions(Orders(use="williams"), laps)
    ('a', 'b', 'c')
    >>> moved_conditions(Orders(use="williams", over=("c", "b")), laps)
    ('b', 'c')
    """
    analysed = tuple(dict.fromkeys(lap.condition for lap in laps if not lap.practice))
    return tuple(c for c in analysed if not orders.over or c in orders.over)


def designed_orders(orders: Orders, conditions: Order) -> tuple[Order, ...]:
    """Return the orders of a design, before any rule is looked at.

    Parameters
    ----------
    orders
        The design.
    conditions
        Those that change places.

    Examples
    --------
    >>> designed_orders(Orders(use="latin"), ("a", "b", "c"))
    (('a', 'b', 'c'), ('b', 'c', 'a'), ('c', 'a', 'b'))
    """
    if orders.use == "fixed":
        return (conditions,)
    if orders.use == "list":
        return tuple(dict.fromkeys(orders.orders))
    if orders.use in ("all", "random"):
        return tuple(itertools.permutations(conditions))
    k = len(conditions)
    first = williams_row(k) if orders.use == "williams" else list(range(k))
    rows = [[(at + shift) % k for at in first] for shift in range(k)]
    if orders.use == "williams" and k % 2:
        rows += [row[::-1] for row in rows]
    return tuple(tuple(conditions[at] for at in row) for row in rows)


def williams_row(k: int) -> list[int]:
    """Return the first row of Williams' square: 0, 1, k - 1, 2, k - 2, ...

    Neighbours differ by every amount once, so that in the rows made from it by counting on each
    condition follows each other one equally often (with the mirrored rows, where k is odd).

    Parameters
    ----------
    k
        Number of conditions, 1 or more.

    References
    ----------
    Williams (1949), Australian J. of Scientific Research A 2(2), 149-168.

    Examples
    --------
    >>> williams_row(4), williams_row(5)
    ([0, 1, 3, 2], [0, 1, 4, 2, 3])
    """
    row, low, high = [0], 1, k - 1
    while low <= high:
        row.append(low)
        if high > low:
            row.append(high)
        low, high = low + 1, high - 1
    return row


def put_in_order(laps: Sequence[PlannedLap], order: Order) -> tuple[PlannedLap, ...]:
    """Return the laps with the analysed laps of some conditions in another order.

    Each goes with what is asked after it; practice laps and other conditions stay in their places.

    Parameters
    ----------
    laps
        As the protocol has them.
    order
        Conditions in the order in which they are to be driven.

    Examples
    --------
    >>> laps = [PlannedLap(condition=c) for c in "ab"]
    >>> [lap.condition for lap in put_in_order(laps, ("b", "a"))]
    ['b', 'a']
    """
    moved = {lap.condition: lap for lap in laps if not lap.practice and lap.condition in order}
    following = iter(order)
    return tuple(
        moved[next(following)] if not lap.practice and lap.condition in moved else lap
        for lap in laps
    )


def untaught(
    laps: Sequence[PlannedLap], conditions: Mapping[str, Condition], *, taught: bool
) -> str | None:
    """Return the first condition whose own model has learnt nothing yet; None when there is none.

    Parameters
    ----------
    laps
        In the order in which they are driven.
    conditions
        By name.
    taught
        Whether the model may have been taught before the study.

    Examples
    --------
    >>> laps = [PlannedLap(condition=c) for c in ("helped", "taught")]
    >>> conditions = {
    ...     "taught": Condition(assistant="demonstrator", training=True),
    ...     "helped": Condition(assistant="model"),
    ... }
    >>> untaught(laps, conditions, taught=False)
    'helped'
    >>> untaught(laps[::-1], conditions, taught=False) is None
    True
    """
    for lap in laps:
        condition = conditions.get(lap.condition)
        if condition is None:
            return None  # an unknown lap may have been the training
        if condition.assistant == "model" and condition.model == "own" and not taught:
            return lap.condition
        taught = taught or condition.training
    return None


def keeps_rules(order: Order, rules: Sequence[Before]) -> bool:
    """Tell whether an order keeps every rule about its conditions.

    Parameters
    ----------
    order
        Conditions in the order in which they are driven.
    rules
        Which one is driven before which.

    Examples
    --------
    >>> keeps_rules(("a", "b"), [Before(first="b", then="a")])
    False
    """
    at = {condition: i for i, condition in enumerate(order)}
    pairs = ((at[r.first], at[r.then]) for r in rules if r.first in at and r.then in at)
    return all(first < then for first, then in pairs)


def legal_orders(
    orders: Orders,
    laps: Sequence[PlannedLap],
    conditions: Mapping[str, Condition],
    *,
    taught: bool,
) -> tuple[Order, ...]:
    """Return the orders of a design that keep the rules and can be taught.

    Parameters
    ----------
    orders
        The design, with its rules.
    laps
        As the protocol has them.
    conditions
        By name.
    taught
        Whether the model may have been taught before the study.

    Examples
    --------
    >>> laps = [PlannedLap(condition=c) for c in ("alone", "taught", "helped")]
    >>> conditions = {
    ...     "alone": Condition(),
    ...     "taught": Condition(assistant="demonstrator", training=True),
    ...     "helped": Condition(assistant="model"),
    ... }
    >>> legal_orders(Orders(use="latin"), laps, conditions, taught=False)
    (('alone', 'taught', 'helped'), ('taught', 'helped', 'alone'))
    """
    wanted = moved_conditions(orders, laps)
    return tuple(
        order
        for order in designed_orders(orders, wanted)
        if keeps_rules(order, orders.before)
        and untaught(put_in_order(laps, order), conditions, taught=taught) is None
    )


def order_faults(orders: Orders, laps: Sequence[PlannedLap]) -> Iterator[Fault]:
    """Find what is wrong with the orders of a protocol, whatever its conditions are.

    Parameters
    ----------
    orders
        The design.
    laps
        As the protocol has them.

    Examples
    --------
    >>> laps = [PlannedLap(condition=c) for c in ("alone", "helped")]
    >>> [fault.message for fault in order_faults(Orders(use="latin", over=("alone",)), laps)]
    ['no latin orders of 1 condition; allowed: 2 or more']
    """
    analysed = [lap.condition for lap in laps if not lap.practice]
    known = dict.fromkeys(analysed)
    named: list[tuple[Location, str]] = [
        (("orders", "over", i), c) for i, c in enumerate(orders.over)
    ]
    for i, rule in enumerate(orders.before):
        named += [(("orders", "before", i, "first"), rule.first),
                  (("orders", "before", i, "then"), rule.then)]  # fmt: skip
    for i, order in enumerate(orders.orders):
        named += [(("orders", "list", i, j), c) for j, c in enumerate(order)]
    unknown = [(where, c) for where, c in named if c not in known]
    for where, c in unknown:
        yield Fault(where, f"'{c}' is not a condition of a lap to analyse; {allowed(c, known)}")
    if unknown or orders.use == "fixed":
        if orders.use == "fixed" and (orders.over or orders.orders):
            yield Fault(("orders", "use"), "a fixed order has no over and no list")
        return
    yield from _shape_faults(orders, moved_conditions(orders, laps), analysed)


def _shape_faults(orders: Orders, moved: Order, analysed: Sequence[str]) -> Iterator[Fault]:
    twice = [c for c in moved if analysed.count(c) > 1]
    if twice:
        message = f"'{twice[0]}' has more than one lap; allowed: over conditions with one lap each"
        yield Fault(("orders", "over"), message)
    if len(moved) < 2:
        message = f"no {orders.use} orders of {len(moved)} condition; allowed: 2 or more"
        yield Fault(("orders", "over"), message)
    if orders.use in ("all", "random") and len(moved) > MOST:
        message = (
            f"all orders of {len(moved)} conditions are too many; allowed: {MOST}, or a square"
        )
        yield Fault(("orders", "over"), message)
    if (orders.use == "list") != bool(orders.orders):
        yield Fault(("orders", "list"), "orders are listed for use: list, and only for it")
    for i, order in enumerate(orders.orders):
        if sorted(order) != sorted(moved):
            wanted = ", ".join(moved)
            message = f"an order names each condition once; allowed: any order of {wanted}"
            yield Fault(("orders", "list", i), message)
