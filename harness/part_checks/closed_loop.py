"""Laps that a part really drives, or helps in: through the lap's one loop, in the Bullet world."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from harness.part_checks.fault import Fault, described
from harness.part_checks.role import (
    ASSISTANT,
    DEMONSTRATOR,
    Role,
    RoleName,
    demonstrator_setup,
    driver_setup,
)
from harness.part_checks.setting import PARTICIPANT, Setting
from harness.part_checks.shown import Moment
from harness.part_checks.tape import PristineWorld, SightKeeper, Tape, moments
from harness.session.arbitration import takeover
from harness.session.clock import VirtualClock
from harness.session.lap import Lap, LapParts, Rules
from harness.session.limitation import Limitation, right_turn_limit, unlimited
from harness.session.seeds import generator
from harness.world.world import World
from participants.registry import make_demonstrator, make_driver
from protocols.condition import AssistantRole
from protocols.course.gates import GateCounter

LIMIT = 0.15
"""What full deflection to the right still gives in a limited lap, rad/s: the paper's."""


@dataclass(frozen=True, slots=True)
class LapPlan:
    """A lap to be driven: with the right turn limitation or not, whose help counts, training."""

    limited: bool = False
    assistant: AssistantRole = "none"
    training: bool = False

    @property
    def limitation(self) -> Limitation:
        """The limitation of the driver's command."""
        return right_turn_limit(LIMIT) if self.limited else unlimited


_DRIVEN = (LapPlan(), LapPlan(), LapPlan(limited=True, assistant="demonstrator"))
_TAUGHT = LapPlan(limited=True, assistant="demonstrator", training=True)
PLANS: Mapping[RoleName, tuple[LapPlan, ...]] = {
    "driver": _DRIVEN,
    "impairment": _DRIVEN,
    "assistant": (_TAUGHT, LapPlan(limited=True, assistant="model")),
    "demonstrator": (LapPlan(limited=True, assistant="demonstrator"), LapPlan(limited=True)),
}
"""What each role goes through. A driver's first two laps are alike, so that they can be compared;
in a demonstrator's second lap its answers do not count."""


@dataclass(slots=True)
class Driven:
    """Laps that were driven.

    Attributes
    ----------
    moments
        Per lap, what was shown in it.
    answers
        Per lap, what the part under check answered.
    fault
        What was raised; None when nothing was.
    """

    moments: list[list[Moment]] = field(default_factory=list)
    answers: list[list[Any]] = field(default_factory=list)
    fault: Fault | None = None


@contextmanager
def bullet_world(setting: Setting) -> Iterator[World]:
    """Give a Bullet world of the setting's course for as long as a context lasts."""
    from harness.world.bullet_world import BulletWorld  # noqa: PLC0415  # loads PyBullet

    world = BulletWorld(setting.course, period=setting.period)
    try:
        yield world
    finally:
        world.close()


@lru_cache(maxsize=2)
def reference_laps(setting: Setting) -> tuple[tuple[Moment, ...], ...]:
    """Return two laps of the autonomous driver: one in which it is helped, one without help.

    The first one teaches; no part is checked in them.
    """
    plans = (_TAUGHT, LapPlan(limited=True))
    with bullet_world(setting) as world:
        driven = drive(ASSISTANT, SightKeeper(), world, setting, plans)
    return tuple(map(tuple, driven.moments))


def drive(
    role: Role,
    part: Any,
    world: World,
    setting: Setting,
    plans: Sequence[LapPlan],
    *,
    lap_s: float | None = None,
) -> Driven:
    """Drive laps with a part in its place; reference parts take the others.

    The lap calls the part itself, with nothing between them, so the part meets what it would meet
    in a study, and can reach what it could reach there.

    Parameters
    ----------
    role, part
        What is checked.
    world
        Of the setting's course. Afterwards the chair is at the start.
    setting
        Course, period and seed.
    plans
        The laps.
    lap_s
        When each ends, s; as the setting has it when None.
    """
    driven, end = Driven(), setting.lap_s if lap_s is None else lap_s
    keeper, parts = _places(role, part, setting)
    for lap, plan in enumerate(plans):
        tape, watched = Tape(role.name), PristineWorld(world)
        try:
            goes_on = _drive_lap(watched, parts, setting, (lap, plan), (tape, end))
        except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code
            where = f"in step {len(tape.steps) + 1} of lap {lap + 1}"
            driven.fault, goes_on = Fault(lap, where, described(error)), False
        shown = moments(tape, watched, keeper.sights, plan.limitation, training=plan.training)
        driven.moments.append(shown)
        driven.answers.append(tape.given)
        if not goes_on:
            break
    world.reset(generator(setting.seed, PARTICIPANT, "at the start"))
    return driven


def _drive_lap(
    world: PristineWorld,
    parts: LapParts,
    setting: Setting,
    planned: tuple[int, LapPlan],
    kept: tuple[Tape, float],
) -> bool:
    """Drive one lap; return whether another one may follow."""
    (lap, plan), (tape, lap_s) = planned, kept
    world.reset(generator(setting.seed, PARTICIPANT, f"lap {lap}/world"))
    parts.driver.start_lap(lap, generator(setting.seed, PARTICIPANT, f"lap {lap}/driver"))
    if parts.demonstrator is not None:
        parts.demonstrator.start_lap()
    parts.model.start_lap()
    rules = Rules(
        limitation=plan.limitation,
        assistant=plan.assistant,
        arbitration=takeover,
        safeguarded=True,
        training=plan.training,
        time_limit_s=lap_s,
    )
    lap_loop = Lap(world, parts, rules, GateCounter(setting.course), tape)
    return lap_loop.drive(tape, VirtualClock()).reason != "withdrew"


def _places(role: Role, part: Any, setting: Setting) -> tuple[SightKeeper, LapParts]:
    """Put the part into its place, and what keeps the sights where it is not in the way."""
    driver = make_driver("autonomous", driver_setup({}, setting))
    if role is DEMONSTRATOR:
        keeper = SightKeeper()
        return keeper, LapParts(driver, part, keeper, onlookers=(keeper,))
    keeper = SightKeeper(make_demonstrator("attentive", demonstrator_setup({}, setting)))
    if role is ASSISTANT:
        return keeper, LapParts(driver, keeper, part)
    return keeper, LapParts(part, keeper, SightKeeper())
