"""One participant's visit, stage by stage."""

from collections.abc import Mapping

from harness.session.arbitration import ARBITRATIONS
from harness.session.clock import Clock, LapStoppedError, VirtualClock
from harness.session.experience import experience_of
from harness.session.journal import Journal
from harness.session.lap import Ending, Lap, Rules
from harness.session.lap_log import LapLog, summary
from harness.session.limitation import limitation_of
from harness.session.model import basis_vectors, saved, tuned_fields
from harness.session.parts import SessionParts, question
from harness.session.seeds import fingerprint, generator
from harness.session.stages import Stage, StageKind, stages_of
from harness.session.study_run import StudyRun
from harness.world.world import World
from lad.assistant import Learner
from participants.driver import WithdrewError, kind_of
from participants.pages import AGREED, Page
from protocols.condition import Condition
from protocols.course.centreline import Centreline
from protocols.course.gates import GateCounter
from protocols.exclusion import exclusion_reason
from protocols.laps import PlannedLap
from protocols.record.rows import (
    ENDS_SESSION,
    LapRow,
    ParticipantRow,
    SurveyRow,
    participant_id,
    questions_follow,
    response_fields,
)
from protocols.record.session import RecordedLap, SessionRecord


class Session:
    """One participant's visit.

    Parameters
    ----------
    run
        The study and its seed.
    number
        The participant, counted from 1.
    world
        Of the study's course; it is reset before every lap.
    parts
        What takes part, as ``make_parts`` returns it, or other people and models in their places.
    clock
        Paces the laps; virtual by default.
    journal
        Told what is applied before it acts; None for no journal.

    Attributes
    ----------
    stages
        What the visit consists of, in order.
    done
        How many of them are over.
    """

    def __init__(
        self,
        run: StudyRun,
        number: int,
        world: World,
        parts: SessionParts,
        *,
        clock: Clock | None = None,
        journal: Journal | None = None,
    ) -> None:
        self._run, self._number, self._world = run, number, world
        self._parts, self._journal = parts, journal
        self._clock: Clock = VirtualClock() if clock is None else clock
        self._centreline = Centreline(run.study.course)
        self.stages = stages_of(run.study.protocol, number, run.seed)
        self.done = 0
        self._ended = False
        self._consented = True
        self._entered: dict[str, object] = {}
        self._laps: list[RecordedLap] = []
        self._answers: list[SurveyRow] = []

    def run(self) -> SessionRecord:
        """Go through the stages that are not over yet, and return the record."""
        while not self.over:
            self.advance()
        return self.record()

    @property
    def over(self) -> bool:
        """Whether nothing is left to do: every stage is over, or the participant has left."""
        return self._ended or self.done == len(self.stages)

    def advance(self) -> Stage:
        """Go through the next stage, and return it."""
        stage = self.stages[self.done]
        try:
            if self._journal is not None:
                self._journal.stage(self.done, stage.kind, stage.lap)
            self._go_through(stage)
        except (WithdrewError, LapStoppedError):  # on a page: a lap records its own end
            self._ended = True
        self.done += 1
        return stage

    def record(self) -> SessionRecord:
        """Return what is on record so far."""
        trained = any(recorded.row.training for recorded in self._laps)
        return SessionRecord(
            participant=self._participant_row(),
            laps=tuple(self._laps),
            answers=tuple(self._answers),
            model=saved(self._parts.lap.model) if trained else None,
        )

    def _go_through(self, stage: Stage) -> None:
        if stage.lap is not None and stage.planned is not None and stage.kind == "lap":
            ending = self._drive(stage.lap, stage.planned)
            self._ended = ending.reason in ENDS_SESSION
        elif stage.planned is not None and stage.kind == "questions":
            if questions_follow(self._laps[-1].row.end_reason):
                self._ask(stage.planned)
        else:
            self._show(stage)

    def _show(self, stage: Stage) -> None:
        """Show a page, and keep what is entered on it."""
        page = self._page(stage.kind, stage.planned)
        entered = self._parts.reader.read(page)
        if self._journal is not None:
            self._journal.page(page.kind, entered)
        if page.kind == "demographics":
            self._entered |= entered
        if page.kind == "consent" and not entered.get(AGREED):
            self._consented, self._ended = False, True

    def _page(self, kind: StageKind, planned: PlannedLap | None) -> Page:
        protocol = self._run.study.protocol
        if kind == "consent" and protocol.consent is not None:
            return Page("consent", protocol.consent.text or "")
        if kind == "demographics":
            return Page("demographics", fields=protocol.demographics)
        if kind == "break" and planned is not None:
            return Page("break", seconds=planned.break_s)
        return Page("debrief", (protocol.debrief.text or "") if protocol.debrief else "")

    def _drive(self, lap: int, planned: PlannedLap) -> Ending:
        """Drive one lap and keep its record."""
        seed, number, parts = self._run.seed, self._number, self._parts.lap
        protocol = self._run.study.protocol
        condition = protocol.conditions[planned.condition]
        self._world.reset(generator(seed, number, f"lap {lap}/world"))
        parts.driver.start_lap(lap, generator(seed, number, f"lap {lap}/driver"))
        if parts.demonstrator is not None:
            parts.demonstrator.start_lap()
        parts.model.start_lap()
        log = LapLog(self._centreline, demonstrated=condition.assistant == "demonstrator")
        gates = GateCounter(self._run.study.course)
        rules = rules_of(condition, planned.time_limit_s, protocol.hold_s, self._world.period)
        ending = Lap(self._world, parts, rules, gates, self._journal).drive(log, self._clock)
        steps = log.table()
        row = LapRow(
            participant=participant_id(number),
            lap=lap,
            condition=planned.condition,
            practice=planned.practice,
            limited=condition.limitation is not None,
            assistant=condition.assistant,
            training=condition.training and isinstance(parts.model, Learner),
            seed=fingerprint(seed, number, f"lap {lap}/world"),
            **summary(steps, ending, self._world.period),
            **log.pauses(),
            **basis_vectors(parts.model),
            **tuned_fields(parts.model),
        )
        self._laps.append(RecordedLap(row, steps))
        return ending

    def _ask(self, planned: PlannedLap) -> None:
        """Ask what is asked after the last lap."""
        questions = self._run.study.questions(planned)
        respondent, row = self._parts.respondent, self._laps[-1].row
        if respondent is None:
            return
        rng = generator(self._run.seed, self._number, f"lap {row.lap}/survey")
        asked = [question(*pair) for pair in questions]
        answers = respondent.answer(asked, experience_of(self._laps), rng)
        if self._journal is not None:
            self._journal.answers(answers)
        self._answers += [
            SurveyRow(
                participant=row.participant,
                lap=row.lap,
                condition=row.condition,
                instrument=instrument.name,
                item=item.id,
                **response_fields(item, answer, instrument.points),
            )
            for (instrument, item), answer in zip(questions, answers, strict=True)
        ]

    def _participant_row(self) -> ParticipantRow:
        protocol, person = self._run.study.protocol, self._parts.person
        rows = [recorded.row for recorded in self._laps]
        planned = sum(stage.kind == "lap" for stage in self.stages)
        reason = exclusion_reason(protocol.exclusion, rows)
        entered: Mapping[str, object] = person.particulars() | self._entered
        return ParticipantRow(
            participant=participant_id(self._number),
            kind=kind_of(self._parts.lap.driver),
            driver=protocol.cohort.driver.use,
            impairment="none" if person.impairment is None else person.impairment.use,
            age_years=entered.get("age_years"),  # type: ignore[arg-type]
            gender=entered.get("gender"),  # type: ignore[arg-type]
            handedness=entered.get("handedness"),  # type: ignore[arg-type]
            traits=person.as_numbers(),
            consented=self._consented,
            completed=len(rows) == planned and all(row.completed for row in rows),
            laps_planned=planned,
            laps_driven=len(rows),
            excluded=reason is not None,
            exclusion_reason=reason,
        )


def rules_of(condition: Condition, time_limit_s: float, hold_s: float, period_s: float) -> Rules:
    """Return what holds in one lap of a condition."""
    return Rules(
        limitation=limitation_of(condition.limitation, period_s),
        assistant=condition.assistant,
        arbitration=ARBITRATIONS[condition.arbitration],
        safeguarded=condition.safeguard,
        training=condition.training,
        time_limit_s=time_limit_s,
        hold_s=hold_s,
    )
