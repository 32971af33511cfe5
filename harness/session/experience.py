"""A participant's experience of a lap, from which a survey is answered."""

from collections.abc import Sequence

import numpy as np
import pyarrow as pa

from participants.survey import LapExperience
from protocols.record.session import RecordedLap
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE


def experience_of(laps: Sequence[RecordedLap]) -> LapExperience:
    """Return a person's experience of the last lap.

    The person's own baseline is the latest earlier lap, practice apart, without limitation and
    without assistance; the first such lap is its own baseline.
    """
    row, steps = laps[-1].row, laps[-1].steps
    free = [
        lap.row
        for lap in laps
        if not (lap.row.practice or lap.row.limited) and lap.row.assistant == "none"
    ]
    return LapExperience(
        lap_time=row.duration_s,
        baseline_time=free[-1].duration_s if free else None,
        assisted_fraction=row.assisted_fraction,
        interventions=row.interventions,
        interference=_interference(steps),
        collisions=row.collisions,
        completed=row.completed,
    )


def _interference(steps: pa.Table) -> float:
    """Return the share of steps in which the assistant opposed what the driver wanted.

    Opposed means: as shares of the chair's top speeds, the driver's intent and the command that
    counted point more than 90 degrees apart.
    """
    assisted = np.asarray(steps["control"]) != "driver"
    if not assisted.any():
        return 0.0
    agreement = (
        steps["intent_v"].to_numpy() * steps["arbitrated_v"].to_numpy() / MAX_SPEED**2
        + steps["intent_w"].to_numpy() * steps["arbitrated_w"].to_numpy() / MAX_TURN_RATE**2
    )
    return float(np.mean(assisted & (agreement < 0)))
