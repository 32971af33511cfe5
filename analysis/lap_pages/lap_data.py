"""A recorded lap as a page holds it: every control step, in whole numbers."""

import base64
from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from analysis.measures.streams import Numbers, Steps, stream, words
from lad.inputs import N_SEGMENTS
from protocols.course.gates import GateCounter
from protocols.course.schema import Course

_MOST = 32_767
"""Largest whole number of two bytes; the one below its negative stands for a missing value."""

_COMMANDS = ("intent", "user", "a", "would", "mean", "executed")
_STREAMS = {
    "t_s": 0.005,
    "x_m": 0.001,
    "y_m": 0.001,
    "heading_rad": 0.0002,
    "clearance_m": 0.001,
    "h": 1.0,
    "h_would": 1.0,
    "p_help": 0.0001,
    "variance": 0.0001,
    **{f"{name}_{part}": 0.0001 for name in _COMMANDS for part in ("v", "w")},
    **{f"segment_{i:02d}": 0.002 for i in range(N_SEGMENTS)},
}
"""Streams that a page holds, and their resolution in their own units; coarser for large values."""


@dataclass(frozen=True, slots=True)
class LapOf:
    """Which lap it is, and how it ended.

    Attributes
    ----------
    participant, lap
        The participant's id; the lap, counted from 0.
    condition
        Its condition; ? where it has no row.
    completed
        Whether the last gate was reached.
    time_s
        Lap time of a finished lap, else how long it lasted, s; NaN where that is not known.
    """

    participant: str
    lap: int
    condition: str
    completed: bool
    time_s: float

    @property
    def key(self) -> str:
        """What a link calls it."""
        return f"{self.participant}-{self.lap}"


def lap_of(row: Mapping[Hashable, Any]) -> LapOf:
    """Return which lap a row of the table of laps is."""
    completed = bool(row["completed"])
    known = pd.to_numeric(row["lap_time_s" if completed else "duration_s"], errors="coerce")
    return LapOf(
        participant=str(row["participant"]),
        lap=int(str(row["lap"])),
        condition=str(row["condition"]),
        completed=completed,
        time_s=float(known) if known is not None else np.nan,
    )


def lap_data(of: LapOf, steps: Steps, course: Course) -> dict[str, Any]:
    """Return a lap as JSON can hold it.

    Parameters
    ----------
    of
        Which lap.
    steps
        Its steps, one or more.
    course
        Where it was driven: which gate is next follows from the positions.

    Returns
    -------
    dict
        ``streams``: by column, ``[resolution, text]``, where the text is base64 of whole numbers of
        two bytes (little endian), -32768 where a value is missing; columns without any value are
        left out. ``control``: where each of its runs begins, and the word. ``gates``: the steps in
        which a gate had been passed first.
    """
    streams = {}
    for name, resolution in _STREAMS.items():
        values = stream(steps, name)
        if name == "heading_rad":
            values = np.arctan2(np.sin(values), np.cos(values))
        if np.isfinite(values).any():
            streams[name] = packed(values, resolution)
    return {
        **lap_label(of),
        "course": course.name,
        "steps": len(steps),
        "streams": streams,
        "control": _runs(steps),
        "gates": _gates(steps, course),
    }


def lap_label(of: LapOf) -> dict[str, Any]:
    """Return which lap it is, as JSON can hold it."""
    return {
        "key": of.key,
        "participant": of.participant,
        "lap": of.lap,
        "condition": of.condition,
        "completed": of.completed,
        "time_s": round(of.time_s, 3) if np.isfinite(of.time_s) else None,
    }


def packed(values: Numbers, resolution: float) -> list[Any]:
    """Return numbers as whole multiples of a resolution, coarser where they would not fit.

    Examples
    --------
    >>> packed(np.array([0.0, 0.5, np.nan]), 0.5)
    [0.5, 'AAABAACA']
    """
    known = np.isfinite(values)
    reach = float(np.abs(values[known]).max(initial=0.0))
    resolution = max(resolution, reach / _MOST)
    whole = np.full(len(values), -_MOST - 1, dtype="<i2")
    whole[known] = np.rint(values[known] / resolution).astype("<i2")
    return [resolution, base64.b64encode(whole.tobytes()).decode()]


def _gates(steps: Steps, course: Course) -> list[int]:
    counter, found = GateCounter(course), list[int]()
    places = np.column_stack([stream(steps, "x_m"), stream(steps, "y_m")]).tolist()
    for i in range(1, len(places)):
        before = counter.passed
        counter.advance((places[i - 1][0], places[i - 1][1]), (places[i][0], places[i][1]))
        found += [i] * (counter.passed - before)
    return found


def _runs(steps: Steps) -> list[list[Any]]:
    """Return who was in control: [first step, word] of each run."""
    control = ["?" if word is None else word for word in words(steps, "control")]
    return [[i, word] for i, word in enumerate(control) if i == 0 or word != control[i - 1]]
