"""A control step as the experimenter's console gets it."""

from typing import Any

from harness.session.lap import Step
from participants.live.driver import command_of
from participants.live.seat import Input


def step_shown(step: Step) -> dict[str, Any]:
    """Return what the console shows of a step: pose, commands, who is in control, the model."""
    model = step.model
    return {
        "t": step.result.t,
        "pose": list(step.result.pose),
        "velocity": list(step.result.velocity),
        "intent": list(step.intent),
        "demonstrator_stick": _demonstrator_stick(step),
        "control": step.control,
        "p_help": model.p_help,
        "variance": model.variance,
        "input_age_s": step.input_age_s,
        "clearance_m": step.result.clearance_m,
    }


def _demonstrator_stick(step: Step) -> list[float] | None:
    """Return where a demonstrator's stick stands, clutch or not: in m/s and rad/s."""
    forward, left = step.telemetry.get("demonstrator_v"), step.telemetry.get("demonstrator_w")
    if forward is not None and left is not None:
        return list(command_of(Input(forward, left)))
    command = step.demonstrator.command if step.demonstrator else None
    return None if command is None else list(command)
