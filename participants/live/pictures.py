"""What each role is shown in a step, as plain data: nothing that the role must not know."""

from typing import Any, Protocol

from lad.command import Command
from participants.sight import Sight
from protocols.pose import Pose


class Moved(Protocol):
    """What is there after a step."""

    @property
    def t(self) -> float:
        """Lap time, s."""

    @property
    def pose(self) -> Pose:
        """Where the chair is."""

    @property
    def velocity(self) -> Command:
        """How fast it is."""

    @property
    def contact(self) -> bool:
        """Whether it touched something."""


def _pose(pose: Pose) -> list[float]:
    return [float(pose.x), float(pose.y), float(pose.heading)]


def _pair(command: Command) -> list[float]:
    return [float(command.v), float(command.w)]


def driver_picture(sight: Sight) -> dict[str, Any]:
    """Return what the person in the chair sees and feels.

    Not in it: the condition, who helps, the model's p(h), clearance, the laser's readings.
    """
    return {
        "t": float(sight.t),
        "pose": _pose(sight.pose),
        "velocity": _pair(sight.velocity),
        "gates": int(sight.gates_passed),
        "helped": bool(sight.helped),
        "contact": bool(sight.contact),
    }


def after_step(result: Moved, *, helped: bool) -> dict[str, Any]:
    """Return what of the driver's picture a step changes; gates are counted later.

    Parameters
    ----------
    result
        What is there after the step.
    helped
        Whether the assistant's command counted in it.
    """
    return {
        "t": float(result.t),
        "pose": _pose(result.pose),
        "velocity": _pair(result.velocity),
        "helped": helped,
        "contact": bool(result.contact),
    }


def demonstrator_picture(sight: Sight, stick: Command) -> dict[str, Any]:
    """Return what a demonstrator watches: the chair, the participant's stick, the laser.

    Not in it: the condition, the model's p(h), and whether the model helps; ``driving`` tells only
    whether the demonstrator itself is in control.

    Parameters
    ----------
    sight
        What there is to see.
    stick
        The participant's command, as limited.
    """
    return {
        "t": float(sight.t),
        "pose": _pose(sight.pose),
        "velocity": _pair(sight.velocity),
        "gates": int(sight.gates_passed),
        "contact": bool(sight.contact),
        "driving": sight.helper == "demonstrator",
        "stick": _pair(stick),
        "ranges": [round(float(value), 3) for value in sight.ranges],
        "fan": [float(sight.bearings[0]), float(sight.bearings[-1]), float(sight.laser)],
    }
