"""Quota and order table of a live study, and what the next participant will get."""

from collections import Counter
from collections.abc import Iterable
from typing import Any, NamedTuple

from harness.live.study import LiveStudy
from protocols.allocation import State
from protocols.order import group_of, in_words, laps_of

_SHOWN: tuple[State, State] = ("usable", "under way")


class Cell(NamedTuple):
    """A group, and an order of the analysed laps in words."""

    group: str | None
    order: str


def outlook(study: LiveStudy) -> dict[str, Any]:
    """Return the quota by group and order, and the next participant.

    Returns
    -------
    dict
        ``quota``: one entry for each group and order with how many are planned, finished and under
        way. ``next``: participant, whether a seat is free for them, and, unless the allocation is
        concealed, its reason, group and laps in their order; None when no one more is wanted.
    """
    progress = study.progress()
    planned = _counted(study, range(1, study.planned + 1))
    slots = {state: [e.slot for e in progress.people if e.state == state] for state in _SHOWN}
    finished, under_way = (_counted(study, slots[state]) for state in _SHOWN)
    quota = [
        {
            **cell._asdict(),
            "planned": n,
            "finished": finished[cell],
            "under_way": under_way[cell],
        }
        for cell, n in sorted(
            planned.items(), key=lambda item: (item[0].group or "", item[0].order)
        )
    ]
    concealed = len(quota) > 1 and study.run.study.protocol.live.allocation == "concealed"
    free = len(progress.active) < study.seats
    return {"quota": quota, "next": _next(study, free=free, concealed=concealed)}


def _counted(study: LiveStudy, slots: Iterable[int]) -> Counter[Cell]:
    return Counter(_cell(study, slot) for slot in slots)


def _cell(study: LiveStudy, slot: int) -> Cell:
    protocol, seed = study.run.study.protocol, study.run.seed
    return Cell(group_of(protocol, slot, seed), in_words(laps_of(protocol, slot, seed)))


def _next(study: LiveStudy, *, free: bool, concealed: bool) -> dict[str, Any] | None:
    given = study.next_allocation()
    if given is None:
        return None
    one = {"participant": study.next_participant(), "free": free}
    if concealed:
        return one
    protocol, seed = study.run.study.protocol, study.run.seed
    return one | {
        "reason": given.reason,
        "group": group_of(protocol, given.slot, seed),
        "laps": [lap.condition for lap in laps_of(protocol, given.slot, seed)],
    }
