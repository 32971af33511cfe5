"""Check a world: it starts at the course's start, gives observations, and follows commands."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from harness.part_checks.common import SAME, in_time
from harness.part_checks.elsewhere import ALLOWED, There, compared
from harness.part_checks.elsewhere import NAME as ELSEWHERE
from harness.part_checks.fault import described
from harness.part_checks.interface import NAME as INTERFACE
from harness.part_checks.interface import missing
from harness.part_checks.lap_part import RESET, Part
from harness.part_checks.play import Played, first_difference
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.setting import Setting
from harness.part_checks.source import PartSource
from harness.part_checks.world_run import WorldRun, run_world
from harness.part_checks.world_sense import (
    follows_commands,
    guards,
    observations_fit,
    starts_at_the_start,
    stays_observed,
)

METHODS: Mapping[str, str] = {
    "reset": "rng",
    "observe": "",
    "safeguard": "command",
    "step": "command",
}
SIGNATURES = ", ".join(f"{name}({given})" for name, given in METHODS.items())


def check_world(
    part: Part, options: Mapping[str, Any] | None = None, setting: Setting | None = None
) -> PartReport:
    """Put a world through what a lap will ask of it.

    Parameters
    ----------
    part
        ``module:factory``, or the factory itself: a function of the course, with ``period`` and
        the options as keyword arguments.
    options
        Further keyword arguments.
    setting
        Course, control period and seed; the four-lap study's by default.

    Raises
    ------
    InputError
        When there is no such part.

    Examples
    --------
    >>> from harness.world.bullet_world import BulletWorld
    >>> report = check_world(BulletWorld)  # doctest: +SKIP
    >>> assert report.passed, report  # doctest: +SKIP
    """
    chosen = setting or Setting()
    source = PartSource(part, "world", {}, options)
    worlds: list[Any] = []
    try:
        return PartReport(source.label, "world", _results(source, chosen, worlds))
    finally:
        for world in worlds:
            _close(world)


def make_world(source: PartSource, setting: Setting) -> Any:
    """Return a new world of the setting's course."""
    return source.factory(setting.course, period=setting.period, **source.options)


def _results(source: PartSource, setting: Setting, worlds: list[Any]) -> tuple[CheckResult, ...]:
    """Return every check's result; the worlds that were made are added to ``worlds``."""
    try:
        worlds += [make_world(source, setting) for _ in range(2)]
    except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code may fail in any way
        fault = f"its factory raises {described(error)}"
        return (CheckResult(INTERFACE, "failed", fault, "factory(course, period=...)"),)
    world, other = worlds
    fitting = _interface(world, setting)
    if fitting.state == "failed":
        return (fitting,)
    first = run_world(world, setting)
    laps = CheckResult.of("lap", first.fault, f"{len(first.asked)} steps", "no error")
    if first.fault is not None:
        return (fitting, laps)
    run_world(world, setting, "lap 1/world")
    later, again = run_world(world, setting), run_world(other, setting)
    return (
        fitting,
        laps,
        starts_at_the_start(first, setting),
        observations_fit(first, world, setting),
        stays_observed(first),
        follows_commands(first, setting),
        guards(first),
        _same(first, again),
        _reset(first, later, again),
        _elsewhere(source, setting, first, again),
        in_time(Played(seconds=[first.seconds]), setting.period),
    )


def _interface(world: Any, setting: Setting) -> CheckResult:
    allowed = f"{SIGNATURES}; period, bearings from right to left, laser_offset"
    fault = missing(world, METHODS) or _wrong_property(world, setting)
    found = f"{type(world).__name__} with {SIGNATURES}"
    return CheckResult.of(INTERFACE, fault, found, allowed)


def _wrong_property(world: Any, setting: Setting) -> str | None:
    for name in ("period", "bearings", "laser_offset"):
        if not hasattr(world, name):
            return f"{type(world).__name__} has no {name}"
    if world.period != setting.period:
        return f"period is {world.period!r}, asked for was {setting.period!r}"
    bearings = np.asarray(world.bearings)
    if bearings.ndim != 1 or len(bearings) < 2 or not (np.diff(bearings) > 0).all():
        return f"bearings of shape {bearings.shape} do not rise"
    return None if np.isfinite(world.laser_offset) else f"laser_offset is {world.laser_offset!r}"


def _same(first: WorldRun, again: WorldRun) -> CheckResult:
    allowed = "two worlds made alike and reset with the same seed give the same, to the bit"
    return _equal(SAME, first, again, allowed, "a second world, made alike, differs")


def _reset(first: WorldRun, later: WorldRun, again: WorldRun) -> CheckResult:
    allowed = "reset with the same seed after other laps, it gives the same, to the bit"
    if first.plain() != again.plain():
        return CheckResult(RESET, "not checked", f"it does not pass '{SAME}'", allowed)
    return _equal(RESET, first, later, allowed, "after other laps it differs")


def _equal(name: str, one: WorldRun, other: WorldRun, allowed: str, what: str) -> CheckResult:
    where = other.fault or first_difference(one.plain(), other.plain())
    fault = None if where is None else f"{what}, first: {where}"
    return CheckResult.of(name, fault, f"{len(one.seen)} observations are the same", allowed)


def _elsewhere(
    source: PartSource, setting: Setting, first: WorldRun, again: WorldRun
) -> CheckResult:
    if first.plain() != again.plain():
        return CheckResult(ELSEWHERE, "not checked", f"it does not pass '{SAME}'", ALLOWED)
    if source.path is None:
        why = f"{source.label} is no function at the top level of a module"
        return CheckResult(ELSEWHERE, "not checked", why, ALLOWED)
    task = partial(run_there, source.path, source.options, setting)
    return compared(task, There(first.plain()))


def run_there(path: str, options: Mapping[str, Any], setting: Setting, _number: int) -> There:
    """Make the world in this process, which is the other one, and drive it through the script."""
    try:
        world = make_world(PartSource(path, "world", {}, options), setting)
        run = run_world(world, setting)
        _close(world)
    except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code may fail in any way
        return There(fault=f"it cannot be made: {described(error)}")
    return There(run.plain(), None, run.fault)


def _close(world: Any) -> None:
    close: Callable[[], None] | None = getattr(world, "close", None)
    if callable(close):
        close()
