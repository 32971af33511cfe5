"""Keeps what was shown and answered in a lap, without standing between the lap and the part."""

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.part_checks.role import RoleName
from harness.part_checks.shown import Moment
from harness.session.clock import Timing
from harness.session.lap import Step
from harness.session.limitation import Limitation
from harness.world.world import Observation, World
from lad.assistant import NO_ASSISTANCE, Assistance, Assistant
from lad.command import Command
from lad.inputs import as_inputs
from participants.sight import Sight
from participants.survey import Answer


class PristineWorld:
    """A world, and a copy of all its observations; no part can write into the copies."""

    def __init__(self, world: World) -> None:
        self._world = world
        self.seen: list[Observation] = []

    @property
    def period(self) -> float:
        """Length of a control step, s."""
        return self._world.period

    @property
    def bearings(self) -> NDArray[np.float64]:
        """Directions of the laser's rays, rad."""
        return self._world.bearings

    @property
    def laser_offset(self) -> float:
        """The laser's mounting point ahead of the driven axle, m."""
        return self._world.laser_offset

    def reset(self, rng: np.random.Generator) -> None:
        """Put the chair at the start."""
        self._world.reset(rng)

    def observe(self) -> Observation:
        """Return the instruments' readings."""
        seen = self._world.observe()
        self.seen.append(deepcopy(seen))
        return seen

    def safeguard(self, command: Command) -> Command:
        """Return what the guard leaves of a command."""
        return self._world.safeguard(command)

    def step(self, command: Command) -> None:
        """Follow a command for one control step."""
        self._world.step(command)

    def __getattr__(self, name: str) -> Any:
        """Be the world in every other respect: a part that reaches for it must find all of it."""
        return getattr(self._world, name)


class SightKeeper:
    """Takes the place of a demonstrator or a model, and keeps what it sees.

    Parameters
    ----------
    inner
        Answers in its place; None for one that never helps.
    """

    def __init__(self, inner: Assistant | None = None) -> None:
        self._inner = inner
        self.sights: list[tuple[int, bool]] = []

    def start_lap(self) -> None:
        """Begin a lap."""
        self.sights = []
        if self._inner is not None:
            self._inner.start_lap()

    def look(self, sight: Sight) -> None:
        """Keep what only the lap itself knows; the rest may have been written into already."""
        self.sights.append((sight.gates_passed, sight.helped))
        inner_look = getattr(self._inner, "look", None)
        if inner_look is not None:
            inner_look(sight)

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Answer as the inner one does."""
        return NO_ASSISTANCE if self._inner is None else self._inner.assist(x)


class Tape:
    """Recorder and journal of one lap: what was asked and answered.

    Parameters
    ----------
    role
        Whose answers to keep.
    """

    def __init__(self, role: RoleName) -> None:
        self._role = role
        self.steps: list[Step] = []
        self.commands: list[Command | None] = []

    def tick(
        self,
        command: Command | None,
        demonstrator: Assistance | None,
        timing: Timing | None,
        telemetry: Mapping[str, Any],
    ) -> None:
        """Keep the driver's answer as it was given; a step has the command in force only."""
        del demonstrator, timing, telemetry
        self.commands.append(command)

    def record(self, step: Step) -> None:
        """Keep one step."""
        self.steps.append(step)

    @property
    def given(self) -> list[Any]:
        """What the part answered, step by step."""
        if self._role == "assistant":
            return [step.model for step in self.steps]
        if self._role == "demonstrator":
            return [step.demonstrator for step in self.steps]
        return self.commands[: len(self.steps)]

    def stage(self, index: int, kind: str, lap: int | None) -> None:
        """Keep nothing."""

    def broken_off(self, reason: str, note: str | None) -> None:
        """Keep nothing."""

    def answers(
        self, answers: Sequence[Answer], seconds: Sequence[float | None] | None = None
    ) -> None:
        """Keep nothing."""

    def page(self, kind: str, entered: Mapping[str, Answer]) -> None:
        """Keep nothing."""

    def repeated(self) -> None:
        """Keep nothing."""


def moments(
    tape: Tape,
    world: PristineWorld,
    sights: Sequence[tuple[int, bool]],
    limitation: Limitation,
    *,
    training: bool,
) -> list[Moment]:
    """Return what was shown in the steps of a lap, as it was before a part could change it."""
    return [
        _moment(step, seen, sight, world, limitation, training=training)
        for step, seen, sight in zip(tape.steps, world.seen, sights, strict=False)
    ]


def _moment(
    step: Step,
    seen: Observation,
    kept: tuple[int, bool],
    world: PristineWorld,
    limitation: Limitation,
    *,
    training: bool,
) -> Moment:
    sight = Sight(
        t=seen.t,
        pose=seen.pose,
        velocity=seen.velocity,
        ranges=seen.ranges,
        bearings=world.bearings.copy(),
        laser=world.laser_offset,
        gates_passed=kept[0],
        helped=kept[1],
    )
    x = as_inputs(limitation(step.intent), seen.velocity, seen.segments)
    told = step.demonstrator if training else None
    return Moment(sight, x, None if told is None else (told.helping, told.command))
