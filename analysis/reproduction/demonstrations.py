"""Recorded demonstrations, as the model gets them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lad.inputs import INPUT_NAMES
from protocols.files.errors import InputError
from protocols.record.reader import Study


@dataclass(frozen=True, slots=True)
class Demonstration:
    """One training lap.

    Attributes
    ----------
    t
        Shape (steps,): seconds since the lap started.
    x
        Shape (steps, 19): the model's inputs.
    helped
        Shape (steps,): whether the demonstrator had taken over.
    action
        Shape (steps, 2): the demonstrator's command, m/s and rad/s; NaN where it had not.
    """

    t: NDArray[np.float64]
    x: NDArray[np.float64]
    helped: NDArray[np.bool_]
    action: NDArray[np.float64]


def demonstrations(study: Study) -> tuple[Demonstration, ...]:
    """Return a study's training laps, participant by participant in the order driven.

    Raises
    ------
    InputError
        When the study has none, or their inputs or the demonstrator's signal were not recorded.
    """
    laps = study.laps.to_pandas()
    conditions = study.protocol.conditions
    taught = laps[[conditions[name].training for name in laps["condition"]]]
    found = tuple(
        _demonstration(study, participant, lap)
        for participant, lap in zip(taught["participant"], taught["lap"], strict=True)
    )
    if not found:
        raise InputError(f"{study.folder}: no training lap in it")
    return found


def _demonstration(study: Study, participant: str, lap: int) -> Demonstration:
    columns = ["t_s", *INPUT_NAMES, "h", "a_v", "a_w"]
    steps = study.steps(participant, lap, columns).to_pandas().astype("float64")
    if steps[["t_s", *INPUT_NAMES, "h"]].isna().to_numpy().any():
        raise InputError(
            f"{study.folder}: {participant}, lap {lap}: inputs or h were not recorded in each step"
        )
    return Demonstration(
        t=steps["t_s"].to_numpy(),
        x=np.ascontiguousarray(steps[list(INPUT_NAMES)].to_numpy()),
        helped=np.asarray(steps["h"].to_numpy() > 0),
        action=steps[["a_v", "a_w"]].to_numpy(),
    )
