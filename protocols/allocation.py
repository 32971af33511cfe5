"""Which slot of the allocation the next living participant gets: decided at enrolment.

A slot is a position in the sequence of orders and groups (``protocols.order`` takes it for the
participant's number). A synthetic cohort needs no enrolment: there participant n has slot n. Living
people withdraw and are excluded; their slots are given again, so that orders and groups balance
over those whose sessions can be used.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

State = Literal["under way", "usable", "withdrawn", "excluded"]


@dataclass(frozen=True, slots=True)
class Enrolled:
    """A participant who has been enrolled.

    Attributes
    ----------
    participant
        The id.
    slot
        The slot given, counted from 1.
    state
        Whether the session is under way, can be used, or why it cannot.
    """

    participant: str
    slot: int
    state: State


@dataclass(frozen=True, slots=True)
class Allocation:
    """A slot, and why it is that one.

    Attributes
    ----------
    slot
        Counted from 1.
    reason
        In words, for the record and the experimenter.
    """

    slot: int
    reason: str


def next_allocation(enrolled: Iterable[Enrolled]) -> Allocation:
    """Return the slot of the participant who is enrolled now.

    The lowest slot that no usable session and no session under way holds: first those of people who
    withdrew or were excluded, then the next new one. What the slot means is looked up only when it
    is given, so who enrols next cannot be chosen by it.

    Parameters
    ----------
    enrolled
        Everyone enrolled so far, in any order.

    Examples
    --------
    >>> next_allocation([])
    Allocation(slot=1, reason='the next slot')
    >>> next_allocation([Enrolled("P0001", 1, "withdrawn"), Enrolled("P0002", 2, "usable")])
    Allocation(slot=1, reason='given again: P0001 was withdrawn')
    """
    people = sorted(enrolled, key=lambda e: (e.slot, e.participant))
    held = {e.slot for e in people if e.state in ("under way", "usable")}
    slot = 1
    while slot in held:
        slot += 1
    before = [e for e in people if e.slot == slot]
    if not before:
        return Allocation(slot, "the next slot")
    last = before[-1]
    return Allocation(slot, f"given again: {last.participant} was {last.state}")
