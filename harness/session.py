"""One participant's whole visit: every planned lap, and what is asked after it."""

from harness.arbitration import ARBITRATIONS
from harness.casting import cast, draw_person, question, respondent
from harness.clock import Clock, VirtualClock
from harness.experience import lived
from harness.lap import Ending, Lap, Rules
from harness.lap_log import LapLog, summary
from harness.limitation import right_turn_limit, unlimited
from harness.model import basis_vectors, saved
from harness.plan import Plan
from harness.seeds import fingerprint, stream
from harness.world import World
from lad.assistant import Learner
from protocols.condition import Condition
from protocols.course.centreline import Centreline
from protocols.course.gates import GateCounter
from protocols.exclusion import exclusion_reason
from protocols.plan import PlannedLap
from protocols.record.rows import LapRow, ParticipantRow, SurveyRow, participant_id
from protocols.record.session import RecordedLap, SessionRecord


class Session:
    """One participant's visit.

    Parameters
    ----------
    plan
        The study and its seed.
    number
        The participant, counted from 1.
    world
        Of the study's course; it is reset before every lap.
    clock
        Virtual, unless somebody alive takes part.
    """

    def __init__(self, plan: Plan, number: int, world: World, clock: Clock | None = None) -> None:
        self._plan, self._number, self._world = plan, number, world
        self._clock = clock or VirtualClock()
        self._centreline = Centreline(plan.study.course)
        self._person = draw_person(plan, number)
        self._cast = cast(plan, number, self._person)
        self._respondent = respondent(plan, number, self._person)
        self._laps: list[RecordedLap] = []
        self._answers: list[SurveyRow] = []

    def run(self) -> SessionRecord:
        """Drive every planned lap, ask what the plan asks, and return the record."""
        for lap, planned in enumerate(self._plan.study.protocol.laps):
            ending = self._drive(lap, planned)
            if ending.reason == "withdrew":
                break
            self._ask(lap)
        trained = any(recorded.row.training for recorded in self._laps)
        return SessionRecord(
            participant=self._participant_row(),
            laps=tuple(self._laps),
            answers=tuple(self._answers),
            model=saved(self._cast.model) if trained else None,
        )

    def _drive(self, lap: int, planned: PlannedLap) -> Ending:
        """Drive one lap and keep its record."""
        seed, number = self._plan.seed, self._number
        condition = self._plan.study.protocol.conditions[planned.condition]
        self._world.reset(stream(seed, number, f"lap {lap}/world"))
        cast = self._cast
        cast.driver.start_lap(lap, stream(seed, number, f"lap {lap}/driver"))
        cast.demonstrator.start_lap()
        cast.model.start_lap()
        log = LapLog(self._centreline, demonstrated=condition.assistant == "demonstrator")
        gates = GateCounter(self._plan.study.course)
        rules = _rules(condition, planned.time_limit_s)
        ending = Lap(self._world, cast, rules, gates).drive(log, self._clock)
        steps = log.table()
        row = LapRow(
            participant=participant_id(number),
            lap=lap,
            condition=planned.condition,
            practice=planned.practice,
            limited=condition.limitation is not None,
            assistant=condition.assistant,
            training=condition.training and isinstance(cast.model, Learner),
            seed=fingerprint(seed, number, f"lap {lap}/world"),
            **summary(steps, ending, self._world.period),
            **basis_vectors(cast.model),
        )
        self._laps.append(RecordedLap(row, steps))
        return ending

    def _ask(self, lap: int) -> None:
        """Ask what the plan asks after a lap."""
        questions = self._plan.study.questions(lap)
        if not questions:
            return
        rng = stream(self._plan.seed, self._number, f"lap {lap}/survey")
        experience = lived(self._laps)
        answers = self._respondent.answer([question(*q) for q in questions], experience, rng)
        row = self._laps[-1].row
        self._answers += [
            SurveyRow(
                participant=row.participant,
                lap=lap,
                condition=row.condition,
                instrument=instrument.name,
                item=item.id,
                response=answer,
            )
            for (instrument, item), answer in zip(questions, answers, strict=True)
        ]

    def _participant_row(self) -> ParticipantRow:
        protocol, person = self._plan.study.protocol, self._person
        rows = [recorded.row for recorded in self._laps]
        reason = exclusion_reason(protocol.exclusion, rows)
        return ParticipantRow(
            participant=participant_id(self._number),
            kind="scripted" if protocol.cohort.driver.use == "scripted" else "synthetic",
            driver=protocol.cohort.driver.use,
            impairment="none" if person.impairment is None else person.impairment.use,
            age_years=person.age_years,
            gender=person.gender,
            handedness=person.handedness,
            traits=person.as_numbers(),
            completed=len(rows) == len(protocol.laps) and all(row.completed for row in rows),
            laps_planned=len(protocol.laps),
            laps_driven=len(rows),
            excluded=reason is not None,
            exclusion_reason=reason,
        )


def _rules(condition: Condition, time_limit_s: float) -> Rules:
    limit = condition.limitation
    return Rules(
        limitation=unlimited if limit is None else right_turn_limit(limit.right_turn_rad_s),
        assistant=condition.assistant,
        arbitration=ARBITRATIONS[condition.arbitration],
        safeguarded=condition.safeguard,
        training=condition.training,
        time_limit_s=time_limit_s,
    )
