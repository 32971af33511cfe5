"""Whether a lap can use what a part answers."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from harness.part_checks.plain import type_name
from harness.part_checks.result import CheckResult
from lad.assistant import Assistance
from lad.command import Command
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

NAME = "commands"

SLACK = 1e-9
"""Rounding that does not count as out of range."""

PREDICTED = 10.0
"""A learnt command may exceed the chair's top speeds by this factor: a model that is still learning
does not know where the stick ends, and the chair clips the rest. More is another unit."""


def driver_commands(answers: Mapping[str, Sequence[Any]]) -> CheckResult:
    """Check the answers of a driver: commands within the stick's range, or None."""
    commands = [answer for answer in _all(answers) if isinstance(answer, Command)]
    fault = next(_faults(answers, _driver_fault), None)
    silent = sum(answer is None for answer in _all(answers))
    found = f"{_range(commands)}, {silent} steps without a new command"
    return CheckResult.of(NAME, fault, found, f"a Command of {_allowed(1.0)}, or None")


def assistance(answers: Mapping[str, Sequence[Any]], most: float) -> CheckResult:
    """Check the answers of a demonstrator or an assistant.

    Parameters
    ----------
    answers
        By the lap's name.
    most
        By what factor commands may exceed the chair's top speeds.
    """
    given = [answer for answer in _all(answers) if isinstance(answer, Assistance)]
    commands = [answer.command for answer in given if isinstance(answer.command, Command)]
    fault = next(_faults(answers, lambda answer: assistance_fault(answer, most)), None)
    found = f"{_range(commands)}, helps in {sum(a.helping for a in given)} of {len(given)} steps"
    allowed = (
        f"an Assistance; when it helps, with a Command of {_allowed(most)}; a finite mean, p_help "
        "of 0 to 1, variance of 0 or more, or None"
    )
    return CheckResult.of(NAME, fault, found, allowed)


def command_fault(command: Any, most: float = 1.0) -> str | None:
    """Return what is wrong with a command; None when nothing is.

    Examples
    --------
    >>> command_fault(Command(0.7, -0.5))
    >>> command_fault((0.7, -0.5))
    'a tuple, (0.7, -0.5)'
    >>> command_fault(Command(700.0, 0.0))
    'v=700, w=0'
    """
    if not isinstance(command, Command):
        return f"a {type_name(command)}, {command!r}"[:120]
    if not all(isinstance(value, int | float) for value in command):
        kinds = " and ".join(map(type_name, command))
        return f"a Command of {kinds}, {command!r}"[:120]
    v, w = command
    finite = math.isfinite(v) and math.isfinite(w)
    if finite and abs(v) <= most * MAX_SPEED + SLACK and abs(w) <= most * MAX_TURN_RATE + SLACK:
        return None
    return f"v={v:g}, w={w:g}"


def assistance_fault(answer: Any, most: float) -> str | None:
    """Return what is wrong with an assistant's answer; None when nothing is."""
    if not isinstance(answer, Assistance):
        return f"a {type_name(answer)}, {answer!r}"[:120]
    if not isinstance(answer.helping, bool):
        return f"helping is a {type_name(answer.helping)}, {answer.helping!r}"
    if answer.helping and answer.command is None:
        return "it helps without a command"
    # A mean is recorded, and nothing drives by it: far from what was taught it may be anywhere.
    for name, value, limit in (("command", answer.command, most), ("mean", answer.mean, math.inf)):
        fault = None if value is None else command_fault(value, limit)
        if fault is not None:
            return f"{name} is {fault}"
    return _number_fault("p_help", answer.p_help, 1.0) or _number_fault(
        "variance", answer.variance, math.inf
    )


def _driver_fault(answer: Any) -> str | None:
    if answer is None or isinstance(answer, str):  # a withdrawal
        return None
    return command_fault(answer)


def _number_fault(name: str, value: Any, most: float) -> str | None:
    if value is None:
        return None
    if isinstance(value, int | float) and math.isfinite(value) and 0 <= value <= most:
        return None
    return f"{name} is {value!r}"


def _all(answers: Mapping[str, Sequence[Any]]) -> list[Any]:
    return [answer for lap in answers.values() for answer in lap]


def _faults(answers: Mapping[str, Sequence[Any]], fault_in: Any) -> Iterator[str]:
    for lap, given in answers.items():
        for step, answer in enumerate(given, 1):
            fault = fault_in(answer)
            if fault is not None:
                yield f"{fault}, in step {step} of {lap}"


def _range(commands: Sequence[Command]) -> str:
    if not commands:
        return "no command at all"
    vs, ws = zip(*commands, strict=True)
    return (
        f"v {min(vs):.3g} to {max(vs):.3g} m/s, w {min(ws):.3g} to {max(ws):.3g} rad/s in "
        f"{len(commands)} commands"
    )


def _allowed(most: float) -> str:
    v, w = most * MAX_SPEED, most * MAX_TURN_RATE
    return f"finite numbers, v {-v:g} to {v:g} m/s, w {-w:g} to {w:g} rad/s"
