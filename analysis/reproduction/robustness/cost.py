"""What a step costs: measured on this machine, so never the same bytes twice."""

import json
import time
from collections.abc import Sequence
from pathlib import Path

from analysis.reproduction.demonstrations import Demonstration
from analysis.reproduction.lessons import lessons
from analysis.reproduction.teaching import LearningAssistant, MakeModel, maker
from lad.command import Command
from protocols.record.atomic import write_whole
from protocols.variants import VARIANTS

TAUGHT = 3
"""Demonstrations learnt before the one whose steps are timed."""

COST_FILE = "cost_per_step.json"


def costs(folder: Path) -> dict[str, float]:
    """Return the cost of a step by variant, us: measured once, then kept in the folder.

    Parameters
    ----------
    folder
        The reproduction's; gets ``cost_per_step.json``, the one file of it that differs from run
        to run.

    Raises
    ------
    InputError
        When the demonstrations are not there.
    OSError
        When it cannot be written.
    """
    path = folder / COST_FILE
    if path.is_file():
        kept = json.loads(path.read_text())
        if kept.keys() == {variant.name for variant in VARIANTS}:
            return {name: float(value) for name, value in kept.items()}
    laps = lessons(folder).laps
    found = {v.name: round(step_cost(maker(v.model), laps), 1) for v in VARIANTS}
    write_whole(path, (json.dumps(found, indent=1) + "\n").encode())
    return found


def step_cost(make_model: MakeModel, laps: Sequence[Demonstration]) -> float:
    """Return the mean wall time of predicting and learning a step of a fourth demonstration, us.

    What a model does when the lap starts, such as a new fit, is shared among the lap's steps.
    """
    model = make_model()
    for lap in laps[:TAUGHT]:
        _teach(model, lap)
    timed = laps[min(TAUGHT, len(laps) - 1)]
    return 1e6 * _teach(model, timed) / len(timed.t)


def _teach(model: LearningAssistant, lap: Demonstration) -> float:
    lessons = [
        (x, bool(h), Command(*a.tolist()) if h else None)
        for x, h, a in zip(lap.x, lap.helped, lap.action, strict=True)
    ]
    begun = time.perf_counter()
    model.start_lap()
    for x, helped, command in lessons:
        model.assist(x)
        model.learn(helped, command)
    return time.perf_counter() - begun
