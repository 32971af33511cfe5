"""One pass over the steps of every analysed lap: its measures, and what maps and models need."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames, as_frame
from analysis.measures.registry import MEASURES
from analysis.measures.streams import Steps, gaps, helped, stream
from protocols.record.steps import STEP_COLUMNS

POOLED = ("x_m", "y_m", "h_would", "p_help")
"""Numeric step columns that are kept of every lap."""


@dataclass(frozen=True, slots=True)
class LapRecords:
    """What the steps of the analysed laps say.

    Attributes
    ----------
    measures
        One row per lap: participant, lap, condition, completed and every measure.
    steps
        One row per step: participant, condition, position, whether assistance counted (``helped``,
        0, 1 or NaN), h_would, p_help, section and its kind.
    without_steps
        Analysed laps whose steps were not recorded.
    unrecorded
        Step columns without a value in any analysed lap.
    gaps
        What cannot be used of steps that were recorded, in words, and in how many laps.
    """

    measures: pd.DataFrame
    steps: pd.DataFrame
    without_steps: int
    unrecorded: tuple[str, ...] = ()
    gaps: Mapping[str, int] = field(default_factory=dict)


def read_laps(frames: StudyFrames, progress: Callable[[str], None] | None = None) -> LapRecords:
    """Read the steps of every analysed lap once.

    Raises
    ------
    InputError
        When a step file is damaged; names it.
    """
    rows, pooled, without = [], [], 0
    unrecorded = [column.name for column in STEP_COLUMNS]
    found: Counter[str] = Counter()
    laps = frames.laps
    keys = zip(laps["participant"], laps["lap"], laps["condition"], laps["completed"], strict=True)
    for done, (participant, lap, condition, completed) in enumerate(keys):
        if progress is not None and done % 20 == 0:
            progress(f"Measuring laps: {done} of {len(laps)}")
        where = {"participant": participant, "lap": lap, "condition": condition}
        if frames.study.has_steps(participant, lap):
            steps = as_frame(frames.study.steps(participant, lap))
            found.update(gaps(steps))
            pooled.append(_kept(steps, participant, condition))
            unrecorded = [name for name in unrecorded if steps[name].isna().all()]
        else:
            steps = pd.DataFrame()
            without += 1
        measured = {m.name: m.of(steps) for m in MEASURES} if len(steps) else {}
        rows.append({**where, "completed": bool(completed), **measured})
    names = [m.name for m in MEASURES]
    columns = ["participant", "lap", "condition", "completed", *names]
    measures = pd.DataFrame(rows, columns=columns).astype(
        {**dict.fromkeys(names, "float64"), "completed": "bool"}
    )
    nowhere = tuple(unrecorded) if pooled else ()
    return LapRecords(measures, _together(pooled), without, nowhere, dict(sorted(found.items())))


def _kept(steps: Steps, participant: str, condition: str) -> pd.DataFrame:
    on = helped(steps)
    unknown = np.full(len(steps), np.nan)
    frame = pd.DataFrame({name: stream(steps, name).astype(np.float32) for name in POOLED})
    frame["helped"] = (unknown if on is None else on).astype(np.float32)
    for name in ("section", "section_kind"):
        frame[name] = pd.Categorical(steps[name].to_numpy(dtype=object))
    frame.insert(0, "participant", participant)
    frame.insert(1, "condition", condition)
    return frame


def _together(pooled: Sequence[pd.DataFrame]) -> pd.DataFrame:
    labels = ("participant", "condition", "section", "section_kind")
    if not pooled:
        names = [*labels, *POOLED, "helped"]
        return pd.DataFrame({name: pd.Series(dtype="float64") for name in names})
    frame = pd.concat(pooled, ignore_index=True)
    return frame.astype(dict.fromkeys(labels, "category"))
