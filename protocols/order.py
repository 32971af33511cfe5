"""Who is in which group, and which laps they drive in which order: the one place that says so."""

import zlib
from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from protocols.laps import PlannedLap
from protocols.orders import Order, legal_orders, put_in_order
from protocols.shipped_parts import LAD
from protocols.study import StudyProtocol

T = TypeVar("T")


def laps_of(protocol: StudyProtocol, number: int, seed: int) -> tuple[PlannedLap, ...]:
    """Return a participant's laps in the order in which they are driven.

    A function of protocol, participant and seed alone: it does not depend on who else takes part.

    Parameters
    ----------
    protocol
        The study.
    number
        The participant, counted from 1.
    seed
        The study's seed, 0 or more.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> [lap.condition for lap in laps_of(load_protocol("four-lap"), 1, 0)][:2]
    ['familiarisation', 'baseline']
    """
    if protocol.orders.use == "fixed":
        return protocol.laps
    return put_in_order(protocol.laps, _order_of(protocol, number, seed))


def group_of(protocol: StudyProtocol, number: int, seed: int) -> str | None:
    """Return a participant's group; None in a study without groups.

    Groups come in blocks as long as their ratios add up to, each block shuffled for itself: after
    every block their sizes have the ratio that the protocol asks for.

    Parameters
    ----------
    protocol
        The study.
    number
        The participant's number, from 1.
    seed
        The study's seed.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> group_of(load_protocol("four-lap"), 1, 0) is None
    True
    """
    slots = [name for name, group in protocol.groups.items() for _ in range(group.ratio)]
    if not slots:
        return None
    return in_blocks(slots, max(number, 1) - 1, _key(protocol, seed), "groups")


def of_participant(protocol: StudyProtocol, number: int, seed: int) -> StudyProtocol:
    """Return the protocol as it is for one participant: with what is different for the group.

    Parameters
    ----------
    protocol
        The study.
    number
        The participant's number, from 1.
    seed
        The study's seed.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> protocol = load_protocol("four-lap")
    >>> of_participant(protocol, 1, 0) is protocol  # no groups in it
    True
    """
    name = group_of(protocol, number, seed)
    if name is None:
        return protocol
    group = protocol.groups[name]
    changes: dict[str, object] = {"conditions": {**protocol.conditions, **group.conditions}}
    if group.model is not None:
        changes["model"] = group.model
    if group.demonstrator is not None:
        cohort = protocol.cohort.model_copy(update={"demonstrator": group.demonstrator})
        changes["cohort"] = cohort
    return protocol.model_copy(update=changes)


def in_words(laps: Sequence[PlannedLap]) -> str:
    """Return the order of the analysed laps, as the record keeps it.

    Parameters
    ----------
    laps
        In the order in which they are driven.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> in_words(load_protocol("four-lap").laps)
    'baseline > limited > human-assisted > model-assisted'
    """
    return " > ".join(lap.condition for lap in laps if not lap.practice)


def places(laps: Sequence[PlannedLap]) -> tuple[int | None, ...]:
    """Return each lap's place among the analysed laps, counted from 1; None for practice.

    Parameters
    ----------
    laps
        In the order in which they are driven.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> places(load_protocol("four-lap").laps)
    (None, 1, 2, 3, 4)
    """
    counted = 0
    found: list[int | None] = []
    for lap in laps:
        counted += not lap.practice
        found.append(None if lap.practice else counted)
    return tuple(found)


def in_blocks(values: Sequence[T], index: int, key: int, purpose: str) -> T:
    """Return one of a sequence in which every block is a shuffle of the values.

    Parameters
    ----------
    values
        One block.
    index
        Whose turn it is, counted from 0.
    key, purpose
        From which the shuffles come; each block has its own.

    Examples
    --------
    >>> sorted(in_blocks("abc", i, 0, "letters") for i in range(6))
    ['a', 'a', 'b', 'b', 'c', 'c']
    """
    block, at = divmod(index, len(values))
    rng = np.random.default_rng(
        np.random.SeedSequence(key, spawn_key=(block, zlib.crc32(purpose.encode())))
    )
    return values[int(rng.permutation(len(values))[at])]


def _order_of(protocol: StudyProtocol, number: int, seed: int) -> Order:
    """Return a participant's order: balanced within the group, in blocks of all orders."""
    index = max(number, 1) - 1
    group = group_of(protocol, number, seed)
    if group is not None:
        index = sum(group_of(protocol, n, seed) == group for n in range(1, max(number, 1)))
    orders = legal_orders(
        protocol.orders, protocol.laps, protocol.conditions, taught=protocol.model.use != LAD
    )
    if protocol.orders.use == "all":
        return orders[index % len(orders)]
    return in_blocks(orders, index, _key(protocol, seed), f"orders {group or ''}")


def _key(protocol: StudyProtocol, seed: int) -> int:
    """Return where the allocation's randomness comes from.

    That of a registered study comes from the registration: its own data prove that the plan came
    first, since nobody can know the allocation before the plan is frozen.
    """
    return seed if protocol.registration is None else int(protocol.registration, 16)
