"""The data of the reproduction: three recorded studies, and models taught again from one."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from analysis.frames import StudyFrames, study_frames
from analysis.reproduction.accuracy import accuracy_table
from analysis.reproduction.lap_times import lap_time_table
from analysis.reproduction.lessons import STUDIES, lessons
from analysis.reproduction.teaching import Run, maker, teach_in_orders
from protocols.record.reader import open_study


@dataclass(frozen=True, slots=True)
class Evidence:
    """Everything that rows and figures are made from.

    Attributes
    ----------
    seed
        Of all three studies.
    laps, people
        The studies ``rd-laps`` and ``four-lap``.
    lap_times
        ``rd-laps`` by condition; see ``analysis.reproduction.lap_times``.
    runs
        The demonstrations of ``rd-accuracy``, taught to fresh models in random orders.
    accuracy
        Their accuracy lap by lap; see ``analysis.reproduction.accuracy``.
    """

    seed: int
    laps: StudyFrames
    people: StudyFrames
    lap_times: pd.DataFrame
    runs: tuple[Run, ...]
    accuracy: pd.DataFrame


def gather(folder: Path, jobs: int = 1, tell: Callable[[int, int], None] | None = None) -> Evidence:
    """Read the studies of a reproduction, and teach the demonstrations in random orders.

    Parameters
    ----------
    folder
        The reproduction's.
    jobs
        Processes that teach, 1 or more.
    tell
        Called with how many models have been taught, and of how many.

    Raises
    ------
    InputError
        When one of the studies is not there or cannot be used.
    """
    laps = study_frames(open_study(folder / STUDIES / "rd-laps"))
    people = study_frames(open_study(folder / STUDIES / "four-lap"))
    taught = lessons(folder)
    fresh = maker(taught.study.protocol.model)
    runs = teach_in_orders(fresh, taught.laps, taught.orders, jobs, tell)
    return Evidence(
        seed=taught.study.seed or 0,
        laps=laps,
        people=people,
        lap_times=lap_time_table(laps),
        runs=runs,
        accuracy=accuracy_table(runs),
    )
