"""What an experimenter sees and may do: every action is recorded with its reason."""

from collections.abc import Callable
from typing import Any

from harness.live.messages import Order
from harness.live.outlook import outlook
from harness.live.study import LiveStudy
from harness.live.visit import Visit
from protocols.allocation import Enrolled
from protocols.order import group_of, in_words, laps_of

ACTOR = "experimenter"

THIN = 4
"""Of so many steps of a trail one is sent."""


def _emergency(visit: Visit, note: str | None) -> None:
    visit.stop(ACTOR, "stopped", "emergency stop" + (f": {note}" if note else ""))


_ORDERS: dict[str, Callable[[Visit, str | None], None]] = {
    "start": lambda visit, note: visit.start_lap(ACTOR, note),
    "pause": lambda visit, note: visit.pause(ACTOR, note),
    "resume": lambda visit, note: visit.resume(ACTOR, note),
    "stop": lambda visit, note: visit.stop(ACTOR, "stopped", note),
    "repeat": lambda visit, note: visit.repeat(ACTOR, note),
    "emergency": _emergency,
    "note": lambda visit, note: visit.event(ACTOR, "note", note),
    "skip": lambda visit, note: visit.skip(ACTOR, note),
    "end": lambda visit, note: visit.end(note),
    "withdraw": lambda visit, note: visit.withdraw(ACTOR, note or "withdrawn by the experimenter"),
}


def carry_out(study: LiveStudy, order: Order) -> None:
    """Do what an experimenter ordered.

    Of a session that is over only the data can be withdrawn, where the consent promised that they
    are deleted; every other order for it does nothing.
    """
    visit = study.visits.get(order.participant)
    if visit is not None and not visit.over:
        _ORDERS[order.do](visit, order.text or None)
    elif order.do == "withdraw" and study.purges and order.participant in study.visits:
        study.purge(order.participant)


def shown(study: LiveStudy, *, whole: bool) -> dict[str, Any]:
    """Return what the console shows.

    Parameters
    ----------
    study
        The study.
    whole
        Whether trails, people, quota and the next participant are in it: they change slowly.
    """
    progress = study.progress()
    news: dict[str, Any] = {
        "type": "console",
        "planned": progress.planned,
        "finished": list(progress.finished),
        "sessions": [visit.snapshot() for visit in tuple(study.visits.values())],
    }
    if whole:
        news["trails"] = {
            name: visit.trail()[::THIN] for name, visit in tuple(study.visits.items())
        }
        news["people"] = [_person(study, person) for person in progress.people]
        news["outlook"] = outlook(study)
    return news


def _person(study: LiveStudy, person: Enrolled) -> dict[str, Any]:
    """Return a row of the table of people: what was given, why, and what became of it."""
    protocol, seed = study.run.study.protocol, study.run.seed
    given = study.allocations.get(person.participant)
    return {
        "participant": person.participant,
        "state": person.state,
        "slot": person.slot,
        "reason": None if given is None else given.reason,
        "order": in_words(laps_of(protocol, person.slot, seed)),
        "group": group_of(protocol, person.slot, seed),
    }
