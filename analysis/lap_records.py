"""One pass over the steps of every analysed lap: its measures, and what maps and models need."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames, as_frame, within
from analysis.measures.registry import MEASURES
from analysis.measures.streams import Steps, gaps, helped, stream
from protocols.files.errors import InputError
from protocols.record.elsewhere.placement import Placement, said_of
from protocols.record.reader import Study
from protocols.record.steps import STEP_COLUMNS

POOLED = ("x_m", "y_m", "h_would", "p_help")
"""Numeric step columns that are kept of every lap."""


@dataclass(frozen=True, slots=True)
class LapRecords:
    """What follows from the steps of the analysed laps.

    Attributes
    ----------
    measures
        One row per lap: participant, lap, condition, completed and every measure.
    steps
        One row per step: participant, condition, position, whether assistance counted (``helped``,
        0, 1 or NaN), h_would, p_help, section and its kind.
    without_steps
        Analysed laps whose steps were not recorded: no step table, an empty one, or a damaged one.
    unrecorded
        Step columns without a value in any analysed lap.
    gaps
        What cannot be used of steps that were recorded, in words, and in how many laps.
    damaged
        Step tables that cannot be read, and why, in words; their laps count as without steps.
    misplaced
        Laps whose positions are not on the course, and what they may be, in words; no map is drawn
        from them.
    """

    measures: pd.DataFrame
    steps: pd.DataFrame
    without_steps: int
    unrecorded: tuple[str, ...] = ()
    gaps: Mapping[str, int] = field(default_factory=dict)
    damaged: tuple[str, ...] = ()
    misplaced: tuple[str, ...] = ()


def read_laps(frames: StudyFrames, progress: Callable[[str], None] | None = None) -> LapRecords:
    """Read the steps of every analysed lap once.

    A step table that cannot be read is named, and its lap kept as one without steps: the other
    laps can still be analysed.
    """
    rows, pooled = [], []
    unrecorded = [column.name for column in STEP_COLUMNS]
    found: Counter[str] = Counter()
    damaged: list[str] = []
    elsewhere: list[Placement] = []
    laps = frames.laps
    keys = zip(laps["participant"], laps["lap"], laps["condition"], laps["completed"], strict=True)
    for done, (participant, lap, condition, completed) in enumerate(keys):
        if progress is not None and done % 20 == 0:
            progress(f"Measuring laps: {done} of {len(laps)}")
        where = {"participant": participant, "lap": lap, "condition": condition}
        try:
            steps, remarks, placement = _steps(frames.study, participant, lap)
        except InputError as error:
            damaged.append(within(frames.study, error))
            steps = pd.DataFrame()
        if len(steps):
            found.update((*remarks, *gaps(steps)))
            if not placement.on_course:
                elsewhere.append(placement)
            pooled.append(_kept(steps, participant, lap, condition, placement))
            unrecorded = [name for name in unrecorded if steps[name].isna().all()]
        measured = {m.name: m.of(steps) for m in MEASURES} if len(steps) else {}
        rows.append({**where, "completed": bool(completed), **measured})
    names = [m.name for m in MEASURES]
    columns = ["participant", "lap", "condition", "completed", *names]
    measures = pd.DataFrame(rows, columns=columns).astype(
        {**dict.fromkeys(names, "float64"), "completed": "bool"}
    )
    return LapRecords(
        measures=measures,
        steps=_together(pooled),
        without_steps=len(laps) - len(pooled),
        unrecorded=tuple(unrecorded) if pooled else (),
        gaps=dict(sorted(found.items())),
        damaged=tuple(damaged),
        misplaced=tuple(said_of(elsewhere)),
    )


def _steps(study: Study, participant: str, lap: int) -> tuple[Steps, tuple[str, ...], Placement]:
    """Return a lap's steps and what was found about them; an empty frame without a record.

    Distances between positions that are not in metres are no distances: those are left out.
    """
    if not study.has_steps(participant, lap):
        return pd.DataFrame(), (), Placement(on_course=True)
    table, remarks, placement = study.lap_steps(participant, lap)
    steps = as_frame(table)
    if not (placement.on_course or placement.metres):
        steps = steps.assign(x_m=np.nan, y_m=np.nan)
    return steps, remarks, placement


def _kept(
    steps: Steps, participant: str, lap: int, condition: str, placement: Placement
) -> pd.DataFrame:
    on = helped(steps)
    unknown = np.full(len(steps), np.nan)
    if not placement.on_course:
        steps = steps.assign(x_m=np.nan, y_m=np.nan)
    return pd.DataFrame(
        {
            "participant": participant,
            "lap": np.int16(lap),
            "condition": condition,
            **{name: stream(steps, name).astype(np.float32) for name in POOLED},
            "helped": (unknown if on is None else on).astype(np.float32),
            **{
                name: pd.Categorical(steps[name].to_numpy(dtype=object))
                for name in ("section", "section_kind")
            },
        }
    )


def _together(pooled: Sequence[pd.DataFrame]) -> pd.DataFrame:
    labels = ("participant", "condition", "section", "section_kind")
    if not pooled:
        names = [*labels, "lap", *POOLED, "helped"]
        return pd.DataFrame({name: pd.Series(dtype="float64") for name in names})
    frame = pd.concat(pooled, ignore_index=True)
    return frame.astype(dict.fromkeys(labels, "category"))
