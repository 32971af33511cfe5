"""Studies on other courses, driven with the models that laps on the default course have taught."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from analysis.frames import StudyFrames, as_frame, study_frames
from analysis.measures.streams import Steps, helped
from analysis.reproduction.lessons import STUDIES
from analysis.reproduction.robustness.evidence import ROBUSTNESS, lap_times
from protocols.course.centreline import Centreline
from protocols.files.errors import InputError
from protocols.record.reader import open_study
from protocols.variants import DEFAULT

GENERALISATION = "generalisation"
"""The folder of these studies, in the one of a reproduction's studies: one by course."""


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """A course, and the results of the laps on it.

    Attributes
    ----------
    course
        Its name.
    kinds
        Its kinds of sections in the order of the first of each.
    laps
        Lap times, s: rows replicates, columns conditions. An unfinished lap counts as the time it
        was given.
    finished
        Of the same shape: whether the lap was finished.
    shares
        One row per replicate and kind of section: ``assisted`` and ``would``, the shares of steps
        in which the model helped, and in which the demonstrator would have.
    """

    course: str
    kinds: tuple[str, ...]
    laps: pd.DataFrame
    finished: pd.DataFrame
    shares: pd.DataFrame


def gather(folder: Path) -> tuple[Elsewhere, ...]:
    """Read the study of every course: first the one that the models were taught on.

    Its laps with help are those of the very models that drive on the others.

    Raises
    ------
    InputError
        When there is no such study, or one cannot be used.
    """
    studies = folder / STUDIES
    home = study_frames(open_study(studies / ROBUSTNESS / DEFAULT.name))
    alone = lap_times(study_frames(open_study(studies / "rd-laps")))
    laps, finished = (
        a[["baseline", "limited"]].assign(demonstrator=t["demonstrator"], model=t["model after 3"])
        for a, t in zip(alone, lap_times(home), strict=True)
    )
    there = sorted(path for path in (studies / GENERALISATION).glob("*") if path.is_dir())
    if not there:
        raise InputError(f"{studies / GENERALISATION}: no study in it")
    first = Elsewhere(
        home.study.course.name, _kinds(home), laps, finished, _shares(home, "model after 3")
    )
    return (first, *(_elsewhere(study_frames(open_study(path))) for path in there))


def _elsewhere(frames: StudyFrames) -> Elsewhere:
    return Elsewhere(
        frames.study.course.name,
        _kinds(frames),
        *lap_times(frames),
        _shares(frames, "model"),
    )


def _kinds(frames: StudyFrames) -> tuple[str, ...]:
    return tuple(dict.fromkeys(s.kind for s in Centreline(frames.study.course).sections))


def _shares(frames: StudyFrames, condition: str) -> pd.DataFrame:
    laps = frames.laps[frames.laps["condition"] == condition]
    rows = (
        row
        for participant, lap in zip(laps["participant"], laps["lap"], strict=True)
        for row in _lap_shares(frames, participant, lap)
    )
    return pd.DataFrame(rows, columns=["participant", "kind", "steps", "assisted", "would"])


def _lap_shares(frames: StudyFrames, participant: str, lap: int) -> Iterable[dict[str, object]]:
    steps = frames.study.steps(participant, lap)
    on = helped(Steps(steps))
    known = as_frame(steps).assign(
        on=False if on is None else on, would=lambda known: known["h_would"] > 0
    )
    for kind, here in known.groupby("section_kind", sort=False, observed=True):
        yield {
            "participant": participant,
            "kind": str(kind),
            "steps": len(here),
            "assisted": float(here["on"].mean()),
            "would": float(here["would"].mean()),
        }
