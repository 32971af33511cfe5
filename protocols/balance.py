"""What a protocol's orders balance, in words: how many can be driven, and how even places are."""

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise

from protocols.orders import Order, designed_orders, legal_orders, moved_conditions
from protocols.shipped_parts import LAD
from protocols.study import StudyProtocol


def orders_of(protocol: StudyProtocol) -> tuple[Order, ...]:
    """Return the orders of the conditions that participants of a study may drive."""
    taught = protocol.model.use != LAD
    return legal_orders(protocol.orders, protocol.laps, protocol.conditions, taught=taught)


def balance_in_words(protocol: StudyProtocol) -> Iterator[str]:
    """Yield what to know of a protocol's orders, a sentence each; nothing for a fixed order.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> for sentence in balance_in_words(load_protocol("four-lap-balanced")):
    ...     print(sentence)
    4 orders of 4 conditions, all of which can be driven
    every condition has every place equally often, and follows every other one equally often
    a block of orders is 4 participants: 12 make 3 whole blocks
    """
    if protocol.orders.use == "fixed":
        return
    moved = moved_conditions(protocol.orders, protocol.laps)
    designed = designed_orders(protocol.orders, moved)
    orders = orders_of(protocol)
    legal = "all of which" if len(orders) == len(designed) else f"{len(orders)} of which"
    yield f"{len(designed)} orders of {len(moved)} conditions, {legal} can be driven"
    yield _evenness(orders, moved)
    n, whole = protocol.cohort.participants, len(orders)
    if n % whole:
        yield (
            f"a block of orders is {whole} participants: {n} end in the middle of one, so places "
            "are not quite even"
        )
    else:
        yield f"a block of orders is {whole} participants: {n} make {_blocks(n // whole)}"


def groups_in_words(protocol: StudyProtocol) -> str | None:
    """Return how a protocol's groups are filled; None for a study without groups.

    Examples
    --------
    >>> from protocols.groups import Group
    >>> from protocols.load import load_protocol
    >>> groups = {"usual": Group(ratio=2), "eager": Group()}
    >>> groups_in_words(load_protocol("four-lap").model_copy(update={"groups": groups}))
    '2 usual and 1 eager in each shuffled block of 3 participants: 12 make 4 whole blocks'
    """
    if not protocol.groups:
        return None
    shares = [f"{group.ratio} {name}" for name, group in protocol.groups.items()]
    block = sum(group.ratio for group in protocol.groups.values())
    n = protocol.cohort.participants
    ends = f"{n} make {_blocks(n // block)}"
    if n % block:
        ends = f"{n} end in the middle of one, so groups are not quite as large as planned"
    each = f"{', '.join(shares[:-1])} and {shares[-1]}"
    return f"{each} in each shuffled block of {block} participants: {ends}"


def _blocks(count: int) -> str:
    return "1 whole block" if count == 1 else f"{count} whole blocks"


def _evenness(orders: tuple[Order, ...], moved: Order) -> str:
    uneven = [
        c
        for c in moved
        if len({Counter(o.index(c) for o in orders)[at] for at in range(len(moved))}) > 1
    ]
    if uneven:
        where = "; ".join(f"{c} at {_places(orders, c)}" for c in uneven)
        return f"place is not balanced: {where}"
    follows = Counter(pair for o in orders for pair in pairwise(o))
    even = len(set(follows.values())) == 1 and len(follows) == len(moved) * (len(moved) - 1)
    carried = "and follows every other one equally often" if even else "but carry-over is not even"
    return f"every condition has every place equally often, {carried}"


def _places(orders: tuple[Order, ...], condition: str) -> str:
    counts = Counter(order.index(condition) + 1 for order in orders)
    return ", ".join(f"place {at} in {counts[at]}" for at in sorted(counts))
