"""Drive a world through a fixed script of commands, and keep all its observations."""

import time
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any, Literal

from harness.part_checks.fault import described
from harness.part_checks.plain import plain
from harness.part_checks.setting import PARTICIPANT, Setting
from harness.session.seeds import generator
from harness.world.world import Observation, World
from lad.command import STILL, Command
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

Phase = Literal["ahead", "stop", "left", "guarded", "wild"]

SCRIPT: tuple[tuple[Phase, float], ...] = (
    ("ahead", 1.5),
    ("stop", 1.5),
    ("left", 1.5),
    ("stop", 1.5),
    ("guarded", 12.0),
    ("wild", 4.0),
)
"""What happens, and for how many seconds each."""

HELD_S = 1.5
"""How long each of the wild commands lasts, s."""

AHEAD, LEFT = Command(0.3, 0.0), Command(0.0, 0.3)


@dataclass(slots=True)
class WorldRun:
    """A world's lap.

    Attributes
    ----------
    phases, asked
        Per step, the phase and the command that was asked for.
    guarded
        Per step, what the guard left of it; None in steps without a guard.
    seen
        The observation before each step, and one after the last.
    seconds
        Per step, how long guarding, moving and observing took, s.
    unstable
        What changed without a step, or after its step; None when nothing did.
    fault
        What was raised; None when nothing was.
    """

    phases: list[Phase] = field(default_factory=list)
    asked: list[Command] = field(default_factory=list)
    guarded: list[Any] = field(default_factory=list)
    seen: list[Observation] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)
    unstable: str | None = None
    fault: str | None = None

    def plain(self) -> list[list[Any]]:
        """Return its observations in a form to be compared."""
        return [[plain(seen) for seen in self.seen]]


def script(setting: Setting) -> Iterator[tuple[Phase, Command]]:
    """Yield each step's phase and command; the wild ones are drawn from the seed."""
    rng = generator(setting.seed, PARTICIPANT, "commands")
    for phase, seconds in SCRIPT:
        for step in range(round(seconds / setting.period)):
            if step % max(1, round(HELD_S / setting.period)) == 0:
                slowest = MAX_SPEED / 2 if phase == "guarded" else -MAX_SPEED
                wild = Command(
                    float(rng.uniform(slowest, MAX_SPEED)),
                    float(rng.uniform(-MAX_TURN_RATE, MAX_TURN_RATE)),
                )
            if phase == "ahead":
                yield phase, AHEAD
            elif phase == "left":
                yield phase, LEFT
            else:
                yield phase, STILL if phase == "stop" else wild


def run_world(world: World, setting: Setting, lap: str = "lap 0/world") -> WorldRun:
    """Reset a world and drive it through the script."""
    run = WorldRun()
    where = "when it is reset"
    try:
        world.reset(generator(setting.seed, PARTICIPANT, lap))
        held = _look(world, run)
        for step, (phase, command) in enumerate(script(setting), 1):
            where = f"in step {step}"
            begun = time.perf_counter()
            left = world.safeguard(command) if phase == "guarded" else None
            world.step(command if left is None else left)
            now = world.observe()
            run.seconds.append(time.perf_counter() - begun)
            run.phases.append(phase)
            run.asked.append(command)
            run.guarded.append(left)
            _note_change(run, held, f"the observation before step {step} changes in that step")
            held = now
            run.seen.append(deepcopy(now))
            if step == 1:
                _note_change(run, world.observe(), "asked again, the world answers differently")
    except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code may fail in any way
        run.fault = f"{where} it raises {described(error)}"
    return run


def _look(world: World, run: WorldRun) -> Observation:
    seen = world.observe()
    run.seen.append(deepcopy(seen))
    return seen


def _note_change(run: WorldRun, now: Observation, what: str) -> None:
    """Compare an observation with the copy kept last."""
    if run.unstable is None and plain(now) != plain(run.seen[-1]):
        run.unstable = what
