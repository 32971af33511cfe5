"""A participant's learnt model, and the windows it looked at in recorded laps."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from lad.command import Command
from lad.inputs import INPUT_NAMES
from lad.lad_assistant import LADAssistant
from lad.trained import from_bytes
from protocols.files.errors import InputError
from protocols.record.reader import Study

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Looked:
    """What a model saw and said in some steps.

    Attributes
    ----------
    windows
        Shape (n, tau, d), newest input first, in the inputs' units.
    steps
        The n steps as recorded, with ``lap``.
    """

    windows: Floats
    steps: pd.DataFrame


def learnt_model(study: Study, participant: str) -> LADAssistant:
    """Return the model that a participant's session left.

    Raises
    ------
    InputError
        When there is no such participant, nothing was learnt, or the model is not a shipped one.
    """
    data = study.model_bytes(participant)
    where = f"{study.folder}: {participant}"
    if data is None:
        raise InputError(f"{where} left no learnt model; allowed: one with a training lap")
    try:
        model = from_bytes(data, where)
    except ValueError as error:
        raise InputError(
            f"{error}; allowed: a model that ships: lad, lad-correction, lad-level"
        ) from None
    if not model.how.n_basis:
        raise InputError(f"{where}: its model was never shown any help; there is no policy yet")
    return model


def looked_at(study: Study, participant: str, laps: list[int], depth: int) -> Looked:
    """Return every step of these laps with the window that the model saw in it."""
    windows, steps = [], []
    for lap in laps:
        table = study.steps(participant, lap).to_pandas().assign(lap=lap)
        x = table[list(INPUT_NAMES)].to_numpy(dtype=np.float64)
        padded = np.vstack([np.zeros((depth - 1, x.shape[1])), x])
        windows += [padded[t : t + depth][::-1] for t in range(len(x))]
        steps.append(table)
    return Looked(np.array(windows), pd.concat(steps, ignore_index=True))


def answers(model: LADAssistant, windows: Floats) -> tuple[Floats, Floats]:
    """Return p(h = 1 | x), shape (n,), and the command, shape (n, 2), at whole windows.

    The model looks at them; what it has learnt does not change.
    """
    said = [model.answer_at(window) for window in windows]
    commands = np.array([a.mean or Command(np.nan, np.nan) for a in said])
    return np.array([a.p_help for a in said], dtype=np.float64), commands
