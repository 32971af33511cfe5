"""The data of the comparison of variants: their lap times, and their accuracy taught again."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames, study_frames
from analysis.outcomes import by_participant
from analysis.reproduction.accuracy import UNDECIDED, accuracy_table
from analysis.reproduction.lessons import STUDIES, lessons
from analysis.reproduction.teaching import maker, teach_in_orders
from protocols.record.reader import open_study
from protocols.variants import VARIANTS, Variant

ROBUSTNESS = "robustness"
"""The folder of the variants' studies, in the one of a reproduction's studies."""

DEMONSTRATIONS = (1, 3)
"""After how many demonstrations laps were helped by a variant."""

Say = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Tried:
    """A variant and its results.

    Attributes
    ----------
    variant
        Which.
    accuracy
        One row per random order and lap; see ``analysis.reproduction.accuracy``.
    laps
        Lap times, s: rows replicates, columns conditions. An unfinished lap counts as the time it
        was given: the least it would have taken.
    finished
        Of the same shape: whether the lap was finished.
    undecided
        Share of steps with |p(h) - 0.5| < 0.001 in the laps of a condition, steps pooled.
    """

    variant: Variant
    accuracy: pd.DataFrame
    laps: pd.DataFrame
    finished: pd.DataFrame
    undecided: Mapping[str, float]


def gather(folder: Path, jobs: int, say: Say) -> tuple[Tried, ...]:
    """Read every variant's study, and teach it the recorded demonstrations in random orders.

    All variants are taught in the same orders, and their replicates drove with the same noise:
    differences are to be taken order by order and replicate by replicate.

    Parameters
    ----------
    folder
        The reproduction's.
    jobs
        Processes that teach, 1 or more.
    say
        Called with a few words about what is being done.

    Raises
    ------
    InputError
        When a study is not there or cannot be used.
    """
    taught = lessons(folder)
    tested: list[Tried] = []
    for i, variant in enumerate(VARIANTS, start=1):
        say(f"Teaching variants in random orders {i}/{len(VARIANTS)}")
        study = study_frames(open_study(folder / STUDIES / ROBUSTNESS / variant.name))
        if variant.same_probabilities:
            accuracy = tested[0].accuracy
        else:
            runs = teach_in_orders(maker(variant.model), taught.laps, taught.orders, jobs)
            accuracy = accuracy_table(runs)
        shares = {f"model after {n}": _undecided(study, f"model after {n}") for n in DEMONSTRATIONS}
        times, finished = lap_times(study)
        tested.append(Tried(variant, accuracy, times, finished, shares))
    return tuple(tested)


def lap_times(frames: StudyFrames) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return lap times, s, unfinished laps as the time they were given; and which were finished."""
    finished = by_participant(frames, "lap_time_s").notna()
    return by_participant(frames, "duration_s"), finished


def _undecided(frames: StudyFrames, condition: str) -> float:
    laps = frames.laps[frames.laps["condition"] == condition]
    p = [
        frames.study.steps(participant, lap, ["p_help"])["p_help"].to_numpy()
        for participant, lap in zip(laps["participant"], laps["lap"], strict=True)
    ]
    return float((np.abs(np.concatenate(p) - 0.5) < UNDECIDED).mean()) if p else float("nan")
