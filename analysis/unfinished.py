"""Conditions in which no lap was finished, and the likely reason."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import pandas as pd

from analysis.frames import as_frame
from protocols.laps import PlannedLap
from protocols.record.reader import Study

MOSTLY = 0.5
"""Share of laps, or of a lap's time, from which a reason is that of most."""


@dataclass(frozen=True, slots=True)
class NobodyFinished:
    """A condition of which laps were begun, and none was finished.

    Attributes
    ----------
    condition
        Its name.
    laps
        How many were begun.
    reason
        What is in the record, and the likely reason, in words.
    """

    condition: str
    laps: int
    reason: str

    @property
    def sentence(self) -> str:
        """The whole, in words."""
        return f"Nobody finished a lap of {self.condition} ({self.laps} begun): {self.reason}."


def nobody_finished(study: Study) -> tuple[NobodyFinished, ...]:
    """Return the conditions, practised ones too, in which no participant finished a lap.

    In the order of the plan; those of which no lap was begun are not among them.
    """
    laps = as_frame(study.laps)
    planned: dict[str, PlannedLap] = {}
    for lap in study.protocol.laps:
        planned.setdefault(lap.condition, lap)
    fastest = laps.loc[laps["completed"].astype(bool), "lap_time_s"].min()
    found = []
    for condition, plan in planned.items():
        own = laps[laps["condition"] == condition]
        if len(own) and not own["completed"].astype(bool).any():
            reason = "; ".join(_reasons(study, own, plan, float(fastest)))
            found.append(NobodyFinished(condition, len(own), reason))
    return tuple(found)


def _reasons(study: Study, laps: pd.DataFrame, plan: PlannedLap, fastest: float) -> Iterator[str]:
    ends = Counter(laps["end_reason"].dropna())
    if not ends:
        yield "why they ended was not recorded"
        return
    yield ", ".join(f"{n} ended by {_END.get(end, str(end))}" for end, n in ends.most_common())
    if ends["time_limit"] > MOSTLY * len(laps):
        limit = f"the time limit of {plan.time_limit_s:g} s"
        if fastest > plan.time_limit_s:
            yield (
                f"likely {limit} is too short: the fastest lap of another condition took "
                f"{fastest:.0f} s"
            )
            return
        if not study.header.group_courses:  # gates of different courses cannot be counted together
            yield from _gates(study, laps, limit)
    yield from _contact(laps)


_END = {
    "time_limit": "the time limit",
    "withdrew": "a withdrawal",
    "stopped": "being stopped",
    "disconnected": "a lost connection",
    "interrupted": "the end of the program",
}


def _gates(study: Study, laps: pd.DataFrame, limit: str) -> Iterator[str]:
    """Say how far they came: a gate that none of them passed may be out of the chair's reach."""
    passed = pd.to_numeric(laps["gates_passed"]).dropna()
    gates = study.course.gates
    if passed.empty:
        return
    most = int(passed.max())
    if most >= len(gates):
        return
    if (passed == most).mean() > MOSTLY and most < len(gates) - 1:
        yield (
            f"{int((passed == most).sum())} of {len(laps)} passed {most} of {len(gates)} gates and "
            f"none came to {gates[most].name}: likely the way there is closed to the chair, or too "
            "hard to drive (`lad-study validate` looks at the course)"
        )
    else:
        yield f"they passed up to {most} of {len(gates)} gates: likely {limit} is too short"


def _contact(laps: pd.DataFrame) -> Iterator[str]:
    touching = pd.to_numeric(laps["contact_time_s"]) / pd.to_numeric(laps["duration_s"])
    share = float(touching.median())
    if share > MOSTLY / 5:
        yield f"the chair touched an obstacle for {100 * share:.0f}% of a lap: likely it was stuck"
