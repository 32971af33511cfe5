"""Whether a world's observations are possible, and it follows and guards commands correctly."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from harness.part_checks.commands import command_fault
from harness.part_checks.plain import type_name
from harness.part_checks.result import CheckResult
from harness.part_checks.setting import Setting
from harness.part_checks.world_run import AHEAD, LEFT, WorldRun
from harness.world.world import Observation, World
from lad.inputs import N_SEGMENTS
from protocols.wheelchair import LASER_RANGE

NEAR = 1e-3
"""How exactly the chair stands at the start without noise, m and rad; and how still, m/s, rad/s."""

LEAST = 0.5
"""Of the way that a command at once obeyed would give, the chair makes at least this share."""

AT_REST = 0.02
"""What may be left of a velocity after the chair was told to stop, m/s and rad/s."""


def starts_at_the_start(run: WorldRun, setting: Setting) -> CheckResult:
    """Check the first observation."""
    seen, start = run.seen[0], setting.course.start
    off = (
        seen.pose.x - start.x,
        seen.pose.y - start.y,
        math.remainder(seen.pose.heading - start.heading, math.tau),
        *seen.velocity,
    )
    found = (
        f"t {seen.t:g} s, off the start by {off[0]:.3g} m, {off[1]:.3g} m and {off[2]:.3g} rad, "
        f"at {off[3]:.3g} m/s and {off[4]:.3g} rad/s"
    )
    right = seen.t == 0 and all(abs(value) <= NEAR for value in off)
    allowed = f"t 0, at the course's start and at rest, within {NEAR:g}"
    return CheckResult.of("start", None if right else found, found, allowed)


def observations_fit(run: WorldRun, world: World, setting: Setting) -> CheckResult:
    """Check every observation's shapes, kinds and ranges."""
    faults = (
        f"{fault}, after {step} steps"
        for step, seen in enumerate(run.seen)
        for fault in _faults(seen, step * setting.period, world.bearings)
    )
    allowed = (
        f"t in steps of {setting.period:g} s; a pose and velocities that are finite; ranges as "
        f"many as bearings and {N_SEGMENTS} segments, 0 to {LASER_RANGE:g} m; clearance 0 or more; "
        "contact true or false"
    )
    found = f"{len(run.seen)} observations of {len(world.bearings)} rays"
    return CheckResult.of("observations", next(faults, None), found, allowed)


def _faults(seen: Observation, t: float, bearings: Any) -> Iterator[str]:
    if not math.isclose(seen.t, t, abs_tol=1e-6):
        yield f"t is {seen.t:g} s instead of {t:g} s"
    if not all(math.isfinite(value) for value in (*seen.pose, *seen.velocity)):
        yield f"pose {tuple(seen.pose)}, velocity {tuple(seen.velocity)}"
    for name, array, shape in (
        ("ranges", seen.ranges, np.shape(bearings)),
        ("segments", seen.segments, (N_SEGMENTS,)),
    ):
        if np.shape(array) != shape:
            yield f"{name} have shape {np.shape(array)} instead of {shape}"
        elif not ((array >= 0) & (array <= LASER_RANGE)).all():
            yield f"{name} are between {np.min(array):g} and {np.max(array):g} m"
    if not (math.isfinite(seen.clearance_m) and seen.clearance_m >= 0):
        yield f"clearance is {seen.clearance_m!r}"
    if not isinstance(seen.contact, bool):
        yield f"contact is a {type_name(seen.contact)}"


def stays_observed(run: WorldRun) -> CheckResult:
    """Check that observing changes nothing, and that an observation stays as it was."""
    allowed = "asked again without a step, the same; an observation given stays as it was"
    found = f"{len(run.seen)} observations stayed as they were"
    return CheckResult.of("observing", run.unstable, found, allowed)


def follows_commands(run: WorldRun, setting: Setting) -> CheckResult:
    """Check that the chair goes where it is told to, anticlockwise for a positive turn."""
    ahead, left, rest = _way_ahead(run), _turned(run), _left_after_stop(run)
    seconds = {p: run.phases.count(p) * setting.period for p in ("ahead", "left")}
    allowed = (
        f"{LEAST * AHEAD.v * seconds['ahead']:.2g} m ahead at least, "
        f"{LEAST * LEFT.w * seconds['left']:.2g} rad to the left at least, then at rest within "
        f"{AT_REST:g}"
    )
    found = (
        f"{ahead:.2f} m ahead at {AHEAD.v:g} m/s in {seconds['ahead']:g} s, {left:.2f} rad to the "
        f"left at {LEFT.w:g} rad/s in {seconds['left']:g} s, {rest:.3f} left after a stop"
    )
    right = (
        LEAST * AHEAD.v <= ahead / seconds["ahead"] <= 1.1 * AHEAD.v
        and LEAST * LEFT.w <= left / seconds["left"] <= 1.1 * LEFT.w
        and rest <= AT_REST
    )
    return CheckResult.of("follows commands", None if right else found, found, allowed)


def _way_ahead(run: WorldRun) -> float:
    a, b = run.seen[0].pose, run.seen[run.phases.count("ahead")].pose
    return (b.x - a.x) * math.cos(a.heading) + (b.y - a.y) * math.sin(a.heading)


def _turned(run: WorldRun) -> float:
    begin = run.phases.index("left")
    a, b = run.seen[begin].pose, run.seen[begin + run.phases.count("left")].pose
    return math.remainder(b.heading - a.heading, math.tau)


def _left_after_stop(run: WorldRun) -> float:
    """Return the larger velocity just before the turn, when the chair has been told to stop."""
    return max(map(abs, run.seen[run.phases.index("left")].velocity))


def guards(run: WorldRun) -> CheckResult:
    """Check that the guard only takes away."""
    allowed = "the command, or less of it: never faster, never the other way; no contact"
    pairs = [
        (asked, left)
        for phase, asked, left in zip(run.phases, run.asked, run.guarded, strict=True)
        if phase == "guarded"
    ]
    faults = [
        f"of {tuple(asked)} it leaves {left!r}" for asked, left in pairs if not _less(asked, left)
    ]
    faults += [
        f"the chair touches something in step {step}, which is guarded"
        for step, (phase, seen) in enumerate(zip(run.phases, run.seen[1:], strict=True), 1)
        if phase == "guarded" and seen.contact
    ]
    changed = sum(asked != left for asked, left in pairs)
    found = f"took something away in {changed} of {len(pairs)} steps"
    return CheckResult.of("safeguard", faults[0] if faults else None, found, allowed)


def _less(asked: Any, left: Any) -> bool:
    if command_fault(left) is not None:
        return False
    return all(
        abs(after) <= abs(before) + 1e-9 and after * before >= 0
        for before, after in zip(asked, left, strict=True)
    )
