"""Quota and order table of a live study, and what the next participant will get."""

from collections import Counter
from collections.abc import Iterable
from typing import Any, NamedTuple

from harness.live.study import LiveStudy
from protocols.order import group_of, in_words, laps_of
from protocols.record.rows import participant_id, participant_number


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
        way. ``next``: participant, group, laps in their order, and whether a seat is free for them;
        None when everyone who is planned has begun.
    """
    progress = study.progress()
    planned = _counted(study, range(1, study.planned + 1))
    finished = _counted(study, map(participant_number, progress.finished))
    under_way = _counted(study, map(participant_number, progress.active))
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
    return {"quota": quota, "next": _next(study, free=len(progress.active) < study.seats)}


def _counted(study: LiveStudy, numbers: Iterable[int]) -> Counter[Cell]:
    return Counter(_cell(study, number) for number in numbers)


def _cell(study: LiveStudy, number: int) -> Cell:
    protocol, seed = study.run.study.protocol, study.run.seed
    return Cell(group_of(protocol, number, seed), in_words(laps_of(protocol, number, seed)))


def _next(study: LiveStudy, *, free: bool) -> dict[str, Any] | None:
    number = study.next_number()
    if number is None:
        return None
    protocol, seed = study.run.study.protocol, study.run.seed
    return {
        "participant": participant_id(number),
        "group": group_of(protocol, number, seed),
        "laps": [lap.condition for lap in laps_of(protocol, number, seed)],
        "free": free,
    }
