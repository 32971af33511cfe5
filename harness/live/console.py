"""What an experimenter may do, carried out: every action is recorded with its reason."""

from collections.abc import Callable

from harness.live.messages import Order
from harness.live.study import LiveStudy
from harness.live.visit import Visit

ACTOR = "experimenter"


def _emergency(visit: Visit, note: str | None) -> None:
    visit.stop(ACTOR, "stopped", "emergency stop" + (f": {note}" if note else ""))


_ORDERS: dict[str, Callable[[Visit, str | None], None]] = {
    "start": lambda visit, note: visit.resume(ACTOR, note),
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
    """Do what an experimenter ordered; an order for a session that is over does nothing."""
    visit = study.visits.get(order.participant)
    if visit is not None and not visit.over:
        _ORDERS[order.do](visit, order.text or None)
