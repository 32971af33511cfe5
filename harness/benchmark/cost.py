"""What a step of each assistant costs, side by side on the same recorded lap."""

import time
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from harness.benchmark.studies import Cell
from harness.session.borrowed import teach_laps
from harness.session.parts import session_model
from lad.assistant import Assistant, Learner
from lad.inputs import INPUT_NAMES
from protocols.record.reader import open_study
from protocols.record.rows import participant_id

BLOCK = 50
"""Steps that are timed at once: the clock's own cost and resolution then do not matter."""

PASSES = 3
"""How often the lap is gone through."""


def step_costs(cells: Sequence[Cell]) -> dict[str, float]:
    """Return the CPU time of a look, microseconds, of each assistant in the first setting.

    Each is taught the first replicate's demonstrations, and looks at the inputs of that replicate's
    last helped lap with the first assistant. They take turns, block by block, so that a busy
    machine slows all of them.

    Parameters
    ----------
    cells
        Run; of the first one's setting, those in which assistants are taught.

    Returns
    -------
    dict
        By the assistant's label; empty where the first setting has no helped lap.
    """
    first = [cell for cell in cells if cell.setting == cells[0].setting]
    models = {cell.entry.label: _taught(cell) for cell in first}
    rows = _inputs(first[0])
    return costs_of(models, rows) if len(rows) >= BLOCK else {}


def costs_of(models: Mapping[str, Assistant], rows: NDArray[np.float64]) -> dict[str, float]:
    """Return the median over blocks of the CPU time of a look, microseconds.

    Parameters
    ----------
    models
        Taught; they look, and learn nothing.
    rows
        Shape (n, 19), n at least ``BLOCK``: the inputs of a lap.
    """
    times: dict[str, list[float]] = {label: [] for label in models}
    for _ in range(PASSES):
        for model in models.values():
            model.start_lap()
        for start in range(0, len(rows) - BLOCK + 1, BLOCK):
            for label, model in models.items():
                times[label].append(_block(model, rows[start : start + BLOCK]))
    return {label: float(np.median(found)) for label, found in times.items()}


def _block(model: Assistant, rows: NDArray[np.float64]) -> float:
    begun = time.process_time()
    for x in rows:
        model.assist(x)
    return 1e6 * (time.process_time() - begun) / len(rows)


def _taught(cell: Cell) -> Assistant:
    model = session_model(cell.run, 1)
    if isinstance(model, Learner):
        teach_laps(model, open_study(cell.folder), participant_id(1))
    return model


def _inputs(cell: Cell) -> NDArray[np.float64]:
    study = open_study(cell.folder)
    laps = study.laps.to_pandas()
    helped = laps[(laps["assistant"] == "model") & (laps["participant"] == participant_id(1))]
    if helped.empty:
        return np.empty((0, len(INPUT_NAMES)))
    lap = helped.iloc[-1]
    steps = study.steps(str(lap["participant"]), int(lap["lap"]), list(INPUT_NAMES)).to_pandas()
    return np.ascontiguousarray(steps[list(INPUT_NAMES)].to_numpy(dtype=np.float64))
