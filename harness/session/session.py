"""One participant's session, stage by stage."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from harness.session.arbitration import ARBITRATIONS
from harness.session.clock import Clock, LapStoppedError, VirtualClock
from harness.session.experience import experience_of
from harness.session.journal import Journal
from harness.session.lap import Ending, Lap, LapParts, Recorder, Rules, Step
from harness.session.lap_log import LapLog, summary
from harness.session.latent_teaching import teach_inferred
from harness.session.limitation import limitation_of
from harness.session.model import basis_vectors, saved, tuned_fields
from harness.session.parts import SessionParts, question
from harness.session.seeds import fingerprint, generator
from harness.session.stages import Stage, StageKind, stages_of
from harness.session.study_run import StudyRun, of_one
from harness.world.world import World
from lad.assistant import Learner
from participants.driver import WithdrewError, kind_of
from participants.pages import AGREED, Page
from participants.survey import response_times_of
from protocols.condition import Condition
from protocols.course.centreline import Centreline
from protocols.course.gates import GateCounter
from protocols.exclusion import exclusion_reason
from protocols.instrument import Instrument, Item
from protocols.laps import WHOLE_SESSION, PlannedLap
from protocols.order import group_of, in_words
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
    """One participant's session.

    Parameters
    ----------
    run
        The study and its seed.
    number
        The participant, counted from 1.
    world
        Of the course that the participant drives; it is reset before every lap.
    parts
        What takes part, as ``make_parts`` returns it, or other people and models in their places.
    clock
        Paces the laps; virtual by default.
    journal
        Told what is applied before it acts; None for no journal.
    watch
        Told of each step after it is recorded; None for no one.
    repeats
        Asked after each lap, with its row, whether the lap is driven once more.

    Attributes
    ----------
    stages
        The stages of the session, in order.
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
        watch: Recorder | None = None,
        repeats: Callable[[LapRow], bool] = lambda _: False,
    ) -> None:
        self._watch, self._repeats = watch, repeats
        self._run, self._number, self._world = of_one(run, number), number, world
        self._parts, self._journal = parts, journal
        self._clock: Clock = VirtualClock() if clock is None else clock
        self._centreline = Centreline(self._run.study.course)
        self.stages = stages_of(run.study.protocol, run.slot_of(number), run.seed)
        self._planned = tuple(
            stage.planned
            for stage in self.stages
            if stage.kind == "lap" and stage.planned is not None
        )
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

    def end(self) -> None:
        """Have nothing follow."""
        self._ended = True

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
        """Return the record so far."""
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
            if not self._ended and self._repeats(self._laps[-1].row):
                self._repeat(stage)
        elif stage.kind == "questions":
            if stage.planned is None:
                self._ask(self._run.study.session_questions, -1, WHOLE_SESSION)
            elif questions_follow(self._laps[-1].row.end_reason):
                row = self._laps[-1].row
                self._ask(self._run.study.questions(stage.planned), row.lap, row.condition)
        else:
            self._show(stage)

    def _repeat(self, stage: Stage) -> None:
        """Put a lap into the session once more, next; it gets the first number that is free."""
        if self._journal is not None:
            self._journal.repeated()
        free = 1 + max(other.lap for other in self.stages if other.lap is not None)
        following = [stage, *self.stages[self.done + 1 :]]
        same = [other for other in following if other.lap == stage.lap]
        rest = [other for other in following if other.lap != stage.lap]
        fresh = [replace(other, lap=free) for other in same]
        self.stages = (*self.stages[: self.done + 1], *fresh, *rest)

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
        seed, number = self._run.seed, self._number
        protocol = self._run.study.protocol
        condition = protocol.conditions[planned.condition]
        parts = self._parts_with(condition)
        self._world.reset(generator(seed, number, f"lap {lap}/world"))
        parts.driver.start_lap(lap, generator(seed, number, f"lap {lap}/driver"))
        if parts.demonstrator is not None:
            parts.demonstrator.start_lap()
        parts.model.start_lap()
        log = LapLog(self._centreline, demonstrated=condition.assistant == "demonstrator")
        gates = GateCounter(self._run.study.course)
        rules = rules_of(condition, planned.time_limit_s, protocol.hold_s, self._world.period)
        recorder = log if self._watch is None else _Both(log, self._watch)
        ending = Lap(self._world, parts, rules, gates, self._journal).drive(recorder, self._clock)
        steps = log.table()
        if condition.latent_h is not None and isinstance(parts.model, Learner):
            rng = generator(seed, number, f"lap {lap}/latent")
            steps = teach_inferred(parts.model, steps, condition.latent_h, rng)
        row = LapRow(
            participant=participant_id(number),
            lap=lap,
            condition=planned.condition,
            practice=planned.practice,
            limited=condition.limitation is not None,
            assistant=condition.assistant,
            training=condition.training and isinstance(parts.model, Learner),
            seed=fingerprint(seed, number, f"lap {lap}/world"),
            place=None if planned.practice else 1 + self._analysed,
            **summary(steps, ending, self._world.period),
            **log.quality(),
            **basis_vectors(parts.model),
            **tuned_fields(parts.model),
        )
        self._laps.append(RecordedLap(row, steps))
        return ending

    @property
    def _analysed(self) -> int:
        """How many laps to analyse are on record; one that was driven again counts twice."""
        return sum(not recorded.row.practice for recorded in self._laps)

    def _parts_with(self, condition: Condition) -> LapParts:
        """Return what takes part in a lap, with the model and the demonstrator of its condition."""
        lap, model, demonstrator = self._parts.lap, condition.model, condition.demonstrator
        if model != "own":
            lap = replace(lap, model=self._parts.models[model])
        if demonstrator != "own":
            lap = replace(lap, demonstrator=self._parts.demonstrators[demonstrator])
        return lap

    def _ask(self, questions: Sequence[tuple[Instrument, Item]], lap: int, condition: str) -> None:
        """Ask what is asked about a lap, or after the last one about all of them."""
        respondent = self._parts.respondent
        if respondent is None:
            return
        rng = generator(self._run.seed, self._number, f"lap {lap}/survey")
        asked = [question(*pair) for pair in questions]
        answers = respondent.answer(asked, experience_of(self._laps), rng)
        seconds = response_times_of(respondent)
        if self._journal is not None:
            self._journal.answers(answers, seconds)
        times = seconds or (None,) * len(asked)
        self._answers += [
            SurveyRow(
                participant=participant_id(self._number),
                lap=lap,
                condition=condition,
                instrument=instrument.name,
                item=item.id,
                response_time_s=time,
                **response_fields(item, answer, instrument.points),
            )
            for (instrument, item), answer, time in zip(questions, answers, times, strict=True)
        ]

    def _participant_row(self) -> ParticipantRow:
        protocol, person = self._run.study.protocol, self._parts.person
        rows = [recorded.row for recorded in self._laps]
        planned = len(self._planned)
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
            completed=sum(row.completed for row in rows) >= planned,
            laps_planned=planned,
            laps_driven=len(rows),
            excluded=reason is not None,
            exclusion_reason=reason,
            order=in_words(self._planned),
            group=group_of(protocol, self._run.slot_of(self._number), self._run.seed),
        )


class _Both:
    """A recorder, and another that is told after it."""

    def __init__(self, first: Recorder, second: Recorder) -> None:
        self._first, self._second = first, second

    def record(self, step: Step) -> None:
        """Keep one step."""
        self._first.record(step)
        self._second.record(step)


def rules_of(condition: Condition, time_limit_s: float, hold_s: float, period_s: float) -> Rules:
    """Return the rules of one lap of a condition."""
    return Rules(
        limitation=limitation_of(condition.limitation, period_s),
        assistant=condition.assistant,
        arbitration=ARBITRATIONS[condition.arbitration],
        safeguarded=condition.safeguard,
        training=condition.training and condition.latent_h is None,
        time_limit_s=time_limit_s,
        hold_s=hold_s,
        corrections=condition.corrections,
    )
