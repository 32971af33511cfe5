"""One live session: a thread that runs it, and the hands that others may lay on it."""

import threading
import traceback
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal

from harness.live.link_watch import LinkWatch
from harness.live.mailbox import Mailbox
from harness.live.punctuality import TOO_LATE_S, lateness_s
from harness.live.repeating import repeating
from harness.live.step_shown import step_shown
from harness.live.visitors import visitors_of
from harness.session.borrowed import make_all_parts
from harness.session.clock import Clock, LapStoppedError, StopReason, VirtualClock, WallClock
from harness.session.journal import FileJournal
from harness.session.lap import Step
from harness.session.parts import Seats
from harness.session.replay import ReplayedClock, events_of, is_next
from harness.session.session import Session
from harness.session.stages import Stage
from harness.session.study_run import StudyRun, of_one
from harness.world.world import World
from participants.driver import WithdrewError, kind_of
from participants.live.pictures import after_step
from participants.live.seat import Request
from protocols.order import group_of
from protocols.record.journal import journal_header, read_journal
from protocols.record.rows import LapRow, participant_id
from protocols.record.session import SessionRecord
from protocols.record.sessions import model_before

GRACE_S = 2.0
"""A lap is paused this long after its person's connection was lost: the chair stands by then."""

TRAIL = 4000
"""Steps that the console's plan and curves show."""

Farewell = Literal["finished", "refused", "unfit", "withdrew", "ended"]
"""How a session ended for its participant: gone through, without consent, on a machine that the
protocol's rule refuses, by their own wish, or by the experimenter's."""


class Visit:
    """One participant's live session.

    Parameters
    ----------
    run, number
        The study, and the participant, counted from 1.
    journal
        Where its journal is kept; its folder exists.
    make_world
        Makes a world of a study's course; called on the session's own thread.
    finish
        Called on that thread with the record, once the session is over.
    fail
        Called on that thread with a traceback, when the session cannot go on or cannot be kept.
    lockstep
        Whether time is simulated and each step waits for its input: for tests, never for people.

    Attributes
    ----------
    participant, demonstrator
        Their seats.
    farewell
        How the session ended for its participant; meaningless before it is over.
    abandoned
        Whether an earlier process began the session: the next browser without a seat gets it.
    group
        The participant's group; None in a study without groups.
    """

    def __init__(
        self,
        run: StudyRun,
        number: int,
        journal: Path,
        make_world: Callable[[StudyRun], World],
        *,
        finish: Callable[["Visit", SessionRecord], None],
        fail: Callable[["Visit", str], None],
        lockstep: bool = False,
    ) -> None:
        self.name = participant_id(number)
        self._run, self._number, self._path = run, number, journal
        self._make_world, self._finish, self._fail = make_world, finish, fail
        self._own = of_one(run, number)  # conditions, demonstrator and course of the group
        self.group = group_of(run.study.protocol, run.slot_of(number), run.seed)
        self._living = visitors_of(self._own)
        self.participant = Mailbox(
            lockstep=lockstep, on_change=lambda there: self._came("participant", there)
        )
        self.demonstrator = Mailbox(
            lockstep=lockstep, on_change=lambda there: self._came("demonstrator", there)
        )
        self._clock: Clock = VirtualClock() if lockstep else WallClock()
        self._journal: FileJournal | None = None
        self._journal_lock = threading.Lock()
        self._stage: Stage | None = None
        self._step: Step | None = None
        self._steps = 0
        self._trail: deque[tuple[Any, ...]] = deque(maxlen=TRAIL)
        self.farewell: Farewell = "finished"
        self._late_s = 0.0
        self._paused_by: set[str] = set()
        self._timer: threading.Timer | None = None
        self._events: deque[dict[str, Any]] = deque(maxlen=50)
        self._again = False
        self._replayed = 0
        self._links = {
            "participant": LinkWatch("driver"),
            "demonstrator": LinkWatch("demonstrator"),
        }
        self.abandoned = journal.exists()
        self.state = "waiting"
        self._thread = threading.Thread(target=self._guarded, name=self.name, daemon=True)

    def start(self) -> None:
        """Begin, or go on where an earlier process was."""
        self._thread.start()

    def join(self, timeout: float | None = None) -> None:
        """Wait until the session is over."""
        self._thread.join(timeout)

    @property
    def over(self) -> bool:
        """Whether the session has ended."""
        return self.state in {"finished", "failed", "interrupted"}

    def wants_demonstrator(self) -> bool:
        """Tell whether a demonstrator stays with this session."""
        return not self.over and self.needs_demonstrator

    @property
    def needs_demonstrator(self) -> bool:
        """Whether a living demonstrator has something to do in the stage at hand."""
        if not self._living.demonstrator or self._stage is None or self._stage.planned is None:
            return False
        shadows = self._run.study.protocol.live.shadow
        return self._stage.kind == "lap" and (self._helped() or shadows)

    # What the experimenter, the participant and the network do --------------------------

    def pause(self, actor: str, note: str | None = None) -> None:
        """Hold the lap before its next step; between two laps, the next one before its first."""
        self._paused_by.add(actor)
        self.event(actor, "pause", note)
        if isinstance(self._clock, WallClock):
            self._clock.pause()

    def resume(self, actor: str, note: str | None = None) -> None:
        """Go on, unless someone else has paused the lap too."""
        self._paused_by.discard(actor)
        self.event(actor, "resume", note)
        if not self._paused_by and isinstance(self._clock, WallClock):
            self._clock.resume()

    def stop(self, actor: str, reason: StopReason, note: str | None = None) -> None:
        """End the lap before its next step; a pause of it by the same actor ends with it."""
        self.event(actor, f"stop ({reason})", note)
        self._paused_by.discard(actor)
        if isinstance(self._clock, WallClock):
            self._clock.stop(reason, note)
            if not self._paused_by:
                self._clock.resume()

    def repeat(self, actor: str, note: str | None = None) -> None:
        """End the lap, and have it driven once more."""
        self._again = True
        self.stop(actor, "stopped", note)

    def start_lap(self, actor: str, note: str | None = None) -> None:
        """Begin the lap that the participant is asked to start, or go on with one that is held."""
        if self.participant.page_kind in {"instructions", "ready"}:
            self.event(actor, "start", note)
            self.participant.skip()
            if actor not in self._paused_by:
                return
        self.resume(actor, note)

    def skip(self, actor: str, note: str | None = None) -> None:
        """Go on to the next stage: a lap is stopped, a page stays unanswered."""
        if self._in_lap():
            self.stop(actor, "stopped", note)
        else:
            self.event(actor, "skip", note)
            self.participant.skip()

    def comfortable(self) -> None:
        """Have the participant end a practice lap, where the protocol allows it."""
        planned = self._stage.planned if self._stage else None
        if self._in_lap() and planned is not None and planned.until_comfortable:
            self.stop("participant", "comfortable")

    def end(self, note: str | None = None, *, actor: str = "experimenter") -> None:
        """End the session: what was done is kept."""
        self.event(actor, "end", note)
        stop = LapStoppedError("interrupted", note)
        for seat in (self.participant, self.demonstrator):
            seat.end(stop)
        if isinstance(self._clock, WallClock):
            self._clock.stop("interrupted", note)

    def withdraw(self, actor: str, reason: str) -> None:
        """Have the participant leave: the session ends."""
        self.event(actor, "withdraw", reason)
        self.participant.withdraw(reason)
        if isinstance(self._clock, WallClock):
            self._clock.resume()

    def event(self, actor: str, event: str, note: str | None = None) -> None:
        """Record that something happened."""
        lap = self._stage.lap if self._stage else None
        entry = {
            "lap": lap,
            "step": self._steps if lap is not None else None,
            "utc": datetime.now(UTC).isoformat(timespec="milliseconds"),
            "actor": actor,
            "event": event,
            "note": note or None,
        }
        with self._journal_lock:
            self._events.append(entry)
            if self._journal is not None:
                self._journal.event(entry)

    def snapshot(self) -> dict[str, Any]:
        """Return what the console shows of this session."""
        step, stage = self._step, self._stage
        shown: dict[str, Any] = {
            "participant": self.name,
            "group": self.group,
            "state": self.state,
            "stage": stage.kind if stage else None,
            "page": self.participant.page_kind,
            "lap": stage.lap if stage else None,
            "condition": stage.planned.condition if stage and stage.planned else None,
            "paused": sorted(self._paused_by),
            "connected": {
                "participant": self.participant.connected,
                "demonstrator": self.demonstrator.connected,
            },
            "round_trip_s": {
                "participant": self.participant.round_trip_s,
                "demonstrator": self.demonstrator.round_trip_s,
            },
            "late_s": self._late_s,
            "events": list(self._events)[-12:],
        }
        if step is not None and stage is not None and stage.kind == "lap":
            shown |= step_shown(step)
        return shown

    def trail(self) -> list[tuple[Any, ...]]:
        """Return the steps of this lap: x, y, control, t, p(h), variance, lateness, input's age."""
        return list(self._trail)

    def _came(self, role: str, there: bool) -> None:
        """Note that a person's connection came or went, and hold the lap for a lost one."""
        self.event(role, "connected" if there else "disconnected")
        if role != "participant":  # a lap goes on without its demonstrator: that is a release
            return
        if self._timer is not None:
            self._timer.cancel()
        on_interruption = self._run.study.protocol.live.on_interruption
        if there and f"lost {role}" in self._paused_by:
            self.resume(f"lost {role}")
        elif not there and self._in_lap():
            left = max(GRACE_S - self.participant.silent_s, 0.0)
            self._timer = threading.Timer(left, self._lost, (role, on_interruption))
            self._timer.daemon = True
            self._timer.start()

    def _lost(self, role: str, on_interruption: str) -> None:
        if self.participant.connected or not self._in_lap():
            return
        if on_interruption == "resume":
            self.pause(f"lost {role}")
        else:
            self.stop("program", "disconnected", f"the {role}'s connection was lost")

    def _in_lap(self) -> bool:
        return self.state == "running" and self._stage is not None and self._stage.kind == "lap"

    # The session's thread ---------------------------------------------------------------

    def record(self, step: Step) -> None:
        """Keep what the console shows of a step."""
        self._step, self._steps = step, self._steps + 1
        pose = step.result.pose
        if step.timing is not None:
            self._late_s = step.timing.late_s
        self._trail.append(
            (round(pose.x, 3), round(pose.y, 3), step.control, round(step.result.t, 2),
             step.model.p_help, step.model.variance, self._late_s, step.input_age_s)
        )  # fmt: skip
        self.participant.show_ahead(after_step(step.result, helped=step.control != "driver"))
        if self._run.study.protocol.live.demonstrator_sees_p_help:
            self.demonstrator.beside = {**self.demonstrator.beside, "p_help": step.model.p_help}
        if self._replayed:  # an earlier process has recorded what happened in it
            self._replayed -= 1
            return
        for role, link in self._links.items():
            for event, note in link.changes(step.telemetry):
                self.event(role, event, note)

    def _guarded(self) -> None:
        try:
            self._finish(self, self._visit())
        except BaseException:  # noqa: BLE001  # whatever it is, the others' sessions go on
            self._fail(self, traceback.format_exc())
            self.state = "failed"
        else:
            self.state = "finished"

    def _visit(self) -> SessionRecord:
        run, name = self._run, self.name
        seats = Seats(
            self.participant if self._living.participant else None,
            _DemonstratorsSeat(self) if self._living.demonstrator else None,
        )
        world = self._make_world(self._own)
        lent = replace(run, previous=model_before(self._path.parents[1], self._number))
        parts = make_all_parts(lent, self._number, self._pilots(world), seats)
        header = journal_header(run.study, run.seed, name, kind_of(parts.lap.driver))
        journal = FileJournal(self._path, header)
        self._open_journal(journal)
        self._replayed = sum("tick" in entry for entry in journal.left)
        people = repeating(parts, journal)
        clock = ReplayedClock(journal, self._clock, self._come_back)
        session = Session(
            run, self._number, world, people,
            clock=clock, journal=journal, watch=self, repeats=self._repeats,
        )  # fmt: skip
        self.state = "running"
        self._take_up_withdrawal()
        if self._living.participant and not journal.left and not self._fit():
            self.farewell = "unfit"
            session.end()
        while not session.over:
            self._stage, self._steps, self._step = session.stages[session.done], 0, None
            planned = self._stage.planned
            practice = planned is not None and planned.until_comfortable
            self.participant.beside = {"practice": practice}
            self.demonstrator.beside = {"shadow": not self._helped()}
            self._trail.clear()
            again = bool(journal.left)
            if self._stage.kind == "lap" and not again:
                self._look_at_machine()
            session.advance()
            if self._stage.kind == "consent" and not again:
                self._agreed(agreed=not session.over)
            journal.sync()
        self._stage = None
        self._journal = None  # what comes later is not the session's
        journal.close()
        record = session.record()
        if self.participant.withdrawal() is not None:
            self.farewell = "withdrew"
        elif self.farewell == "finished":
            broken_off = record.laps and record.laps[-1].row.end_reason == "interrupted"
            if broken_off or session.done < len(session.stages):
                self.farewell = "ended"
        return replace(record, events=events_of(read_journal(self._path)))

    def _pilots(self, world: World) -> World:
        """Return the world in which a pilot teaches: of the study's own course."""
        here = self._own.study.course == self._run.study.course
        return world if here or not self._run.study.protocol.models else self._make_world(self._run)

    def _take_up_withdrawal(self) -> None:
        """Let a withdrawal stand that an earlier process noted, and could not carry out."""
        for event in events_of(read_journal(self._path)):
            if event.event == "withdraw":
                self.participant.withdraw(event.note or "")

    def _helped(self) -> bool:
        """Tell whether the demonstrator's help counts in the stage at hand."""
        planned = self._stage.planned if self._stage else None
        conditions = self._own.study.protocol.conditions
        return planned is not None and conditions[planned.condition].assistant == "demonstrator"

    def _agreed(self, *, agreed: bool) -> None:
        """Record the answer to the consent page, and the version of its text."""
        consent = self._run.study.protocol.consent
        version = consent.version if consent is not None else None
        self.event(
            "participant", "consent", f"version {version}: {'agreed' if agreed else 'refused'}"
        )
        if not agreed and self.participant.withdrawal() is None:
            self.farewell = "refused"

    def _open_journal(self, journal: FileJournal) -> None:
        """Record from here on in a journal, and in it what happened before it could be opened."""
        with self._journal_lock:
            for entry in self._events:
                journal.event(entry)
            self._journal = journal

    def _look_at_machine(self) -> None:
        """Say before a lap that this machine is too busy for it; the experimenter decides."""
        if not isinstance(self._clock, WallClock):
            return
        late = lateness_s()
        if late > TOO_LATE_S:
            allowed = f"allowed: {1000 * TOO_LATE_S:.0f} ms"
            self.event("program", "machine busy", f"wakes {1000 * late:.0f} ms late; {allowed}")

    def _fit(self) -> bool:
        """Have the participant's machine checked; tell whether the session may begin."""
        rules = self._run.study.protocol.live.machine_check
        try:
            measured = self.participant.ask(Request("check"))
        except (WithdrewError, LapStoppedError):
            return False
        rate = measured.get("frame_rate")
        trip = self.participant.median_round_trip_s
        if trip is not None:
            measured = {**measured, "round_trip_ms": round(1000 * trip, 1)}
        slow = isinstance(rate, int | float) and rate < rules.min_frame_rate
        far = trip is not None and 1000 * trip > rules.max_round_trip_ms
        found = ", ".join(f"{name} {value}" for name, value in sorted(measured.items()))
        self.event("program", "machine check failed" if slow or far else "machine check", found)
        return rules.rule == "flag" or not (slow or far)

    def _repeats(self, row: LapRow) -> bool:
        """Tell whether a lap is driven once more: as ordered, or as the protocol has it."""
        if self._journal is not None and self._journal.left:
            return is_next(self._journal, "repeat")
        ordered, self._again = self._again, False
        restarts = self._run.study.protocol.live.on_interruption == "restart"
        return ordered or (restarts and row.end_reason == "disconnected")

    def _come_back(self) -> None:
        """Wait until the participant is back in a lap that a stopped program interrupted."""
        protocol = self._run.study.protocol
        self.event("program", "restarted", "the program had stopped in the middle of a lap")
        if protocol.live.on_interruption != "resume":
            raise LapStoppedError("disconnected", "the program had stopped in this lap")
        if self._living.participant:
            self.participant.ask(Request("ready", {"resumed": True}))


class _DemonstratorsSeat:
    """A demonstrator's seat: nobody waits for it where it has nothing to do."""

    def __init__(self, visit: Visit) -> None:
        self._visit, self._mailbox = visit, visit.demonstrator
        self.latest, self.withdrawal = self._mailbox.latest, self._mailbox.withdrawal

    def show(self, picture: Mapping[str, Any]) -> None:
        """Show the lap, where the demonstrator is to see it."""
        if self._visit.needs_demonstrator:
            self._mailbox.show(picture)

    def ask(self, request: Request) -> Mapping[str, Any]:
        """Wait for a demonstrator where one is needed."""
        if not self._visit.needs_demonstrator:
            return {}
        return self._mailbox.ask(request)
