"""One lap: the order in which things happen in a control step, and when a lap ends."""

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from harness.arbitration import Arbitration
from harness.clock import Clock
from harness.limitation import Limitation
from harness.world import Observation, World
from lad.assistant import NO_ASSISTANCE, Assistance, Assistant, Learner
from lad.command import STILL, Command
from lad.inputs import as_inputs
from participants.driver import Driver, WithdrewError
from participants.sight import Onlooker, Sight
from protocols.course.gates import GateCounter

AssistantRole = Literal["none", "demonstrator", "model"]
EndReason = Literal["finished", "time_limit", "withdrew"]


@dataclass(frozen=True, slots=True)
class Cast:
    """Who is there in every lap: one drives, the others help or only watch."""

    driver: Driver
    demonstrator: Assistant
    model: Assistant


@dataclass(frozen=True, slots=True)
class Rules:
    """What holds in a lap.

    Attributes
    ----------
    limitation
        What the study does to the driver's command.
    assistant
        Whose help counts; the others watch.
    arbitration
        How the driver's and the assistant's commands become one.
    safeguarded
        Whether the last guard against hard collisions is on.
    training
        Whether the model learns from the demonstrator, after each step is recorded.
    time_limit_s
        A lap that takes longer ends unfinished.
    """

    limitation: Limitation
    assistant: AssistantRole
    arbitration: Arbitration
    safeguarded: bool
    training: bool
    time_limit_s: float


@dataclass(frozen=True, slots=True)
class Step:
    """Everything that was seen, said and done in one control step."""

    seen: Observation
    x: NDArray[np.float64]
    intent: Command
    demonstrator: Assistance
    model: Assistance
    control: str
    arbitrated: Command
    executed: Command
    result: Observation


@dataclass(frozen=True, slots=True)
class Ending:
    """How a lap ended: why, after how many seconds, and a withdrawal in its own words."""

    reason: EndReason
    t: float
    gates_passed: int
    withdrawal: str | None = None


class Recorder(Protocol):
    """Whoever writes steps down."""

    def record(self, step: Step) -> None:
        """Keep one step."""


class Lap:
    """A lap in progress.

    Parameters
    ----------
    world
        Reset to the start of the lap.
    cast
        Everybody's ``start_lap`` has been called.
    rules
        What holds in this lap.
    gates
        Counts the gates from the start.
    """

    def __init__(self, world: World, cast: Cast, rules: Rules, gates: GateCounter) -> None:
        self._world = world
        self._cast = cast
        self._rules = rules
        self._gates = gates
        self._seen = world.observe()
        self._intent = STILL
        self._helped = False
        # Asked once: a protocol's isinstance costs more than a model's prediction.
        self._onlookers = [a for a in (cast.demonstrator, cast.model) if isinstance(a, Onlooker)]
        self._learner = cast.model if rules.training and isinstance(cast.model, Learner) else None

    def drive(self, recorder: Recorder, clock: Clock) -> Ending:
        """Drive until the last gate, the time limit or a withdrawal."""
        clock.start()
        while self._seen.t < self._rules.time_limit_s:
            try:
                step = self._step()
            except WithdrewError as withdrawal:
                return self._ending("withdrew", self._seen.t, str(withdrawal))
            recorder.record(step)
            if self._learner is not None:
                self._learner.learn(step.demonstrator.helping, step.demonstrator.command)
            crossed = self._gates.advance(step.seen.pose, step.result.pose)
            if crossed is not None and self._gates.finished:
                return self._ending("finished", step.seen.t + crossed * self._world.period)
            clock.wait_until(step.result.t)
        return self._ending("time_limit", self._seen.t)

    def _step(self) -> Step:
        """Observe, drive, limit, assist, arbitrate, safeguard, move: the one place with the order.

        Prediction comes before learning, so what is recorded is out of sample.
        """
        seen, rules, cast = self._seen, self._rules, self._cast
        sight = self._sight(seen)
        answer = cast.driver.act(sight)
        self._intent = self._intent if answer is None else answer
        limited = rules.limitation(self._intent)
        x = as_inputs(limited, seen.velocity, seen.segments)
        for onlooker in self._onlookers:  # only who stands in the room gets to see it
            onlooker.look(sight)
        demonstrator, model = cast.demonstrator.assist(x), cast.model.assist(x)
        voice = {"none": NO_ASSISTANCE, "demonstrator": demonstrator, "model": model}
        assistance = voice[rules.assistant]
        arbitrated = rules.arbitration(limited, assistance)
        executed = self._world.safeguard(arbitrated) if rules.safeguarded else arbitrated
        self._world.step(executed)
        self._helped = assistance.helping
        self._seen = self._world.observe()
        control = rules.assistant if assistance.helping else "driver"
        return Step(
            seen, x, self._intent, demonstrator, model, control, arbitrated, executed, self._seen
        )

    def _sight(self, seen: Observation) -> Sight:
        return Sight(
            t=seen.t,
            pose=seen.pose,
            velocity=seen.velocity,
            ranges=seen.ranges,
            bearings=self._world.bearings,
            laser=self._world.laser_offset,
            gates_passed=self._gates.passed,
            helped=self._helped,
        )

    def _ending(self, reason: EndReason, t: float, withdrawal: str | None = None) -> Ending:
        return Ending(reason, t, self._gates.passed, withdrawal)
