"""Records a lap's steps, and computes the lap's row from them."""

import math
from typing import Any

import numpy as np
import pyarrow as pa

from harness.session.clock import CATCH_UP_S
from harness.session.lap import Ending, Step
from lad.assistant import Assistance
from lad.command import Command
from protocols.course.centreline import Centreline
from protocols.record.recorder import StepRecorder

NOTHING = (None, None)
"""In the place of a command that was not given."""


class LapLog:
    """Records every stream of every step of one lap.

    Parameters
    ----------
    centreline
        The course's, for arc length and section: only for metrics, not for driving.
    demonstrated
        Whether the demonstrator drives in this lap; otherwise it is a shadow.
    """

    def __init__(self, centreline: Centreline, *, demonstrated: bool) -> None:
        self._centreline = centreline
        self._demonstrated = demonstrated
        self._steps = StepRecorder()
        self._near = 0.0
        self._paused: list[float] = []
        self._late: list[float] = []
        self._ages: list[float] = []

    def record(self, step: Step) -> None:
        """Keep one step."""
        seen, pose = step.seen, step.seen.pose
        result, timing = step.result.pose, step.timing
        h, (v, w) = _demonstration(step.demonstrator)
        model = step.model
        drives = self._demonstrated or step.control == "demonstrator"
        mean_v, mean_w = model.mean or NOTHING
        self._near, offset = self._centreline.locate(pose.x, pose.y, self._near)
        section = self._centreline.section(self._near)
        self._steps.append(
            step.x,
            step=len(self._steps),
            t_s=seen.t,
            intent_v=step.intent.v,
            intent_w=step.intent.w,
            h=h if drives else None,
            a_v=v if drives else None,
            a_w=w if drives else None,
            h_would=h,
            would_v=v,
            would_w=w,
            p_help=model.p_help,
            mean_v=mean_v,
            mean_w=mean_w,
            variance=model.variance,
            control=step.control,
            arbitrated_v=step.arbitrated.v,
            arbitrated_w=step.arbitrated.w,
            executed_v=step.executed.v,
            executed_w=step.executed.w,
            safeguarded=step.executed != step.arbitrated,
            result_v=step.result.velocity.v,
            result_w=step.result.velocity.w,
            x_m=pose.x,
            y_m=pose.y,
            heading_rad=pose.heading,
            arc_m=self._near,
            offset_m=offset,
            section=section.name,
            section_kind=section.kind,
            clearance_m=seen.clearance_m,
            contact=step.result.contact,
            input_age_s=step.input_age_s,
            late_s=None if timing is None else timing.late_s,
            shift_s=None if timing is None else timing.shift_s,
            result_x_m=result.x,
            result_y_m=result.y,
            result_heading_rad=result.heading,
            **step.telemetry,
        )
        sent_age = step.telemetry.get("driver_sent_age_s")
        if sent_age is not None:  # a command that is too old was replaced by a new one: to stand
            self._ages.append(max(step.input_age_s, sent_age))
        if timing is not None:
            self._paused.append(timing.paused_s)
            self._late.append(timing.late_s)

    def table(self) -> pa.Table:
        """Return the lap's steps."""
        return self._steps.table()

    def quality(self) -> dict[str, Any]:
        """Return the lap row's fields about living people's time and links; empty without any."""
        ages = {"input_age_p99_s": float(np.quantile(self._ages, 0.99))} if self._ages else {}
        if not self._paused:
            return ages
        late = self._late
        return {
            "late_share": sum(seconds > CATCH_UP_S for seconds in late) / len(late),
            "pauses": sum(paused > 0 for paused in self._paused),
            "paused_s": math.fsum(self._paused),
            **ages,
        }


def _demonstration(answer: Assistance | None) -> tuple[int | None, Command | tuple[None, None]]:
    """Return what a demonstrator signals, and the command it gives."""
    if answer is None:
        return None, NOTHING
    if answer.helping:
        return 1, answer.command or NOTHING
    return -1, NOTHING


def summary(steps: pa.Table, ending: Ending, period: float) -> dict[str, Any]:
    """Return the lap row's fields that follow from the lap's own steps.

    Parameters
    ----------
    steps
        The lap's step table.
    ending
        How the lap ended.
    period
        Length of a control step, s.
    """
    contact = steps["contact"].to_numpy()
    assisted = np.asarray(steps["control"]) != "driver"
    finished = ending.reason == "finished"
    return {
        "completed": finished,
        "end_reason": ending.reason,
        "withdrawal": ending.note if ending.reason == "withdrew" else None,
        "stop_reason": None if ending.reason == "withdrew" else ending.note,
        "lap_time_s": ending.t if finished else None,
        "duration_s": ending.t,
        "steps": len(contact),
        "collisions": _stretches(contact),
        "contact_time_s": float(contact.sum()) * period,
        "assisted_fraction": float(assisted.mean()) if len(assisted) else 0.0,
        "interventions": _stretches(assisted),
        "gates_passed": ending.gates_passed,
        "last_segments": tuple(map(float, ending.last.segments)),
    }


def _stretches(on: np.ndarray[Any, np.dtype[np.bool_]]) -> int:
    """Count the unbroken stretches of True."""
    return int(np.count_nonzero(np.diff(on.astype(np.int8), prepend=0) == 1))
