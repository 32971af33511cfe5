"""One lap: the order in which things happen in a control step, and when a lap ends."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from harness.session.arbitration import Arbitration
from harness.session.clock import Clock, LapStoppedError, Timing
from harness.session.intervention import Intervention
from harness.session.journal import Journal
from harness.session.limitation import Limitation
from harness.world.world import Observation, World
from lad.assistant import NO_ASSISTANCE, Assistance, Assistant, Learner
from lad.command import STILL, Command
from lad.inputs import as_inputs
from participants.driver import Driver, WithdrewError
from participants.sight import Onlooker, Sight
from participants.telemetry import telemetry_of
from protocols.condition import AssistantRole, Corrections
from protocols.course.gates import GateCounter
from protocols.record.rows import EndReason

HOLD_S = 0.3
"""How long a driver's last command stays in force without a new one, s; a study may set it."""


@dataclass(frozen=True, slots=True)
class LapParts:
    """What takes part in a lap: one drives, the others help or only watch.

    Attributes
    ----------
    driver
        Drives the chair.
    demonstrator
        Helps, or as a shadow gives a command that does not count; None for a study without one.
    model
        Predicts in every step, and helps in conditions with the model as assistant. It is never
        shown the room, whatever methods it has.
    onlookers
        Others who are shown the room, in the same step and before anybody answers.
    """

    driver: Driver
    demonstrator: Assistant | None
    model: Assistant
    onlookers: tuple[Onlooker, ...] = ()


@dataclass(frozen=True, slots=True)
class Rules:
    """The rules of a lap.

    Attributes
    ----------
    limitation
        What the study does to the driver's command.
    assistant
        The assistant whose help counts; the others only watch.
    arbitration
        How the driver's and the assistant's commands are combined.
    safeguarded
        Whether the last guard against hard collisions is on.
    training
        Whether the model learns from the demonstrator, after each step is recorded.
    time_limit_s
        A lap that takes longer ends unfinished.
    hold_s
        How long a driver's last command stays in force without a new one; then the chair is told
        to stop.
    corrections
        When the demonstrator takes over from the model that helps; the model then learns those
        steps and no others. None for a demonstrator who only watches.
    """

    limitation: Limitation
    assistant: AssistantRole
    arbitration: Arbitration
    safeguarded: bool
    training: bool
    time_limit_s: float
    hold_s: float = HOLD_S
    corrections: Corrections | None = None


class Step(NamedTuple):
    """Everything that was seen, answered and done in one control step.

    Attributes
    ----------
    input_age_s
        How old the driver's command is that was used; 0 for one given in this step.
    timing
        How the step's start kept to the wall clock; None in simulated time.
    telemetry
        What living people's links say, by column.
    """

    seen: Observation
    x: NDArray[np.float64]
    intent: Command
    demonstrator: Assistance | None
    model: Assistance
    control: str
    arbitrated: Command
    executed: Command
    result: Observation
    input_age_s: float
    timing: Timing | None
    telemetry: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Ending:
    """How a lap ended.

    Attributes
    ----------
    reason
        As the record has it.
    t
        Lap time at its end, s.
    gates_passed
        How many gates were crossed in order.
    note
        A withdrawal in the participant's words, or why the lap was stopped.
    last
        The observation after the last step.
    """

    reason: EndReason
    t: float
    gates_passed: int
    note: str | None
    last: Observation


class Recorder(Protocol):
    """Keeps steps."""

    def record(self, step: Step) -> None:
        """Keep one step."""


class Lap:
    """A lap in progress.

    Parameters
    ----------
    world
        Reset to the start of the lap.
    parts
        The ``start_lap`` of each has been called.
    rules
        The rules of this lap.
    gates
        Counts the gates from the start.
    journal
        Receives what is applied in each step before the world moves; None for no journal.
    """

    def __init__(
        self,
        world: World,
        parts: LapParts,
        rules: Rules,
        gates: GateCounter,
        journal: Journal | None = None,
    ) -> None:
        self._world = world
        self._parts = parts
        self._rules = rules
        self._gates = gates
        self._journal = journal
        self._bearings, self._laser_offset = world.bearings, world.laser_offset
        self._seen = world.observe()
        self._intent = STILL
        self._intent_t = self._seen.t
        self._helper: AssistantRole = "none"
        # Checked once: a protocol's isinstance costs more than a model's prediction.
        helper: object = parts.demonstrator
        shown = (helper,) if isinstance(helper, Onlooker) else ()
        self._onlookers: tuple[Onlooker, ...] = (*shown, *parts.onlookers)
        self._intervention = None if rules.corrections is None else Intervention(rules.corrections)
        learns = rules.training and isinstance(parts.model, Learner)
        self._links = [link for part in _both(parts) if (link := telemetry_of(part)) is not None]
        self._learner: Learner | None = parts.model if learns else None  # type: ignore[assignment]

    def drive(self, recorder: Recorder, clock: Clock) -> Ending:
        """Drive until the last gate, the time limit, a withdrawal or the clock's stop."""
        try:
            timing = clock.start()
            while self._seen.t < self._rules.time_limit_s:
                step = self._step(timing)
                recorder.record(step)
                self._teach(step)
                crossed = self._gates.advance(step.seen.pose, step.result.pose)
                if crossed is not None and self._gates.finished:
                    return self._ending("finished", step.seen.t + crossed * self._world.period)
                timing = clock.wait_until(step.result.t)
        except WithdrewError as withdrawal:
            return self._broken_off("withdrew", str(withdrawal))
        except LapStoppedError as stop:
            return self._broken_off(stop.reason, stop.note)
        return self._ending("time_limit", self._seen.t)

    def _teach(self, step: Step) -> None:
        """Let the model learn the step, where it is to: while it helps, only what corrects it."""
        if self._learner is None or step.demonstrator is None:
            return
        if self._intervention is None or step.control == "demonstrator":
            self._learner.learn(step.demonstrator.helping, step.demonstrator.command)

    def _step(self, timing: Timing | None) -> Step:
        """Observe, drive, limit, assist, arbitrate, safeguard, move; only here is their order.

        Prediction comes before learning, so what is recorded is out of sample.
        """
        seen, rules, parts = self._seen, self._rules, self._parts
        sight = self._sight(seen)
        answer = parts.driver.act(sight)
        intent, age = self._command_in_force(answer, seen.t)
        limited = rules.limitation(intent)
        x = as_inputs(limited, seen.velocity, seen.segments)
        for onlooker in self._onlookers:  # the model sees its 19 inputs and nothing else
            onlooker.look(sight)
        demonstrator = None if parts.demonstrator is None else parts.demonstrator.assist(x)
        model = parts.model.assist(x)
        role = self._in_charge(demonstrator, model, limited, seen.t)
        answers = {"model": model, "demonstrator": demonstrator}
        assistance = answers.get(role) or NO_ASSISTANCE
        arbitrated = rules.arbitration(limited, assistance)
        executed = self._world.safeguard(arbitrated) if rules.safeguarded else arbitrated
        telemetry = {name: value for link in self._links for name, value in link().items()}
        if self._journal is not None:
            self._journal.tick(answer, demonstrator, timing, telemetry)
        self._world.step(executed)
        self._helper = role if assistance.helping else "none"
        self._seen = self._world.observe()
        control = role if assistance.helping else "driver"
        return Step(
            seen, x, intent, demonstrator, model, control, arbitrated, executed, self._seen,
            age, timing, telemetry,
        )  # fmt: skip

    def _in_charge(
        self, demonstrator: Assistance | None, model: Assistance, user: Command, t: float
    ) -> AssistantRole:
        """Return whose answer counts in this step."""
        if self._intervention is None or demonstrator is None:
            return self._rules.assistant
        intervenes = self._intervention.needed(demonstrator, model, user, t)
        return "demonstrator" if intervenes else self._rules.assistant

    def _command_in_force(self, answer: Command | None, t: float) -> tuple[Command, float]:
        """Return the command in force and its age: without new commands the chair soon stops."""
        if answer is not None:
            self._intent, self._intent_t = answer, t
            return answer, 0.0
        age = t - self._intent_t
        # The step's time is a multiple of the period: half a microsecond is rounding.
        return (self._intent if age <= self._rules.hold_s + 5e-7 else STILL), age

    def _sight(self, seen: Observation) -> Sight:
        return Sight(
            seen.t,
            seen.pose,
            seen.velocity,
            seen.ranges,
            self._bearings,
            self._laser_offset,
            self._gates.passed,
            self._helper != "none",
            seen.contact,
            self._helper,
        )

    def _broken_off(self, reason: EndReason, note: str | None) -> Ending:
        if self._journal is not None:
            self._journal.broken_off(reason, note)
        return self._ending(reason, self._seen.t, note)

    def _ending(self, reason: EndReason, t: float, note: str | None = None) -> Ending:
        return Ending(reason, t, self._gates.passed, note, self._seen)


def _both(parts: LapParts) -> tuple[object, ...]:
    return (parts.driver, parts.demonstrator)
