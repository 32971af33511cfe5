"""Lap times of two conditions, tested as log ratios, with practice and unfinished laps in mind."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from analysis.attainable import smallest_p
from analysis.estimands import timed_laps, worst_differences
from analysis.frames import StudyFrames
from analysis.place import (
    Practice,
    imbalance,
    less_places,
    practice_of,
    restored,
    with_place,
    without_place,
)
from analysis.randomness import generator
from analysis.stats.mixed_model import lap_time_model
from analysis.stats.result import TestResult
from analysis.stats.signed_rank import signed_rank
from protocols.declared import Unfinished


@dataclass(frozen=True, slots=True)
class LapTimeTest:
    """What was tested, and how.

    Attributes
    ----------
    unfinished
        What an unfinished lap counts as.
    practice
        What is done about practice; where it is confounded no verdict on a condition follows.
    test
        Log of the ratio of lap times, condition / reference: the Hodges-Lehmann estimate, its
        interval and Wilcoxon's test, of log times less their place's effect where place is
        balanced (with its spread restored where it is not quite, ``place.restored``); the mixed
        model with the place as a factor where it is only identified.
    seconds
        The Hodges-Lehmann estimate of the differences in s, not adjusted.
    smallest_p
        The smallest p that the test could have given with these pairs; NaN where there is no bound.
    """

    unfinished: Unfinished
    practice: Practice
    test: TestResult
    seconds: TestResult
    smallest_p: float = math.nan


def lap_time_test(
    frames: StudyFrames, condition: str, reference: str, unfinished: Unfinished = "complete pairs"
) -> LapTimeTest:
    """Compare lap times of two conditions within participants.

    Parameters
    ----------
    frames
        The study.
    condition, reference
        Ratios are condition over reference.
    unfinished
        What an unfinished lap counts as.
    """
    laps = with_place(timed_laps(frames, unfinished))
    rng = generator(frames.study, f"lap times, {unfinished}: {condition} / {reference}")
    return compare_laps(laps, condition, reference, unfinished, rng)


def compare_laps(
    laps: pd.DataFrame,
    condition: str,
    reference: str,
    unfinished: Unfinished,
    rng: np.random.Generator,
) -> LapTimeTest:
    """Compare lap times of two conditions of a table of laps; see ``lap_time_test``.

    Parameters
    ----------
    laps
        participant, condition, place, lap_time_s, and for ``worst rank`` also ``worst``.
    rng
        For the permutation test, where the mixed model has to fall back on it.
    """
    timed = laps.dropna(subset=["lap_time_s"])
    practice = practice_of(timed, condition, reference)
    times = timed.assign(value=np.log(timed["lap_time_s"].to_numpy(dtype=np.float64)))
    seconds = _wide(times.assign(value=times["lap_time_s"]), laps, condition, reference)
    found = _signed(seconds, laps, condition, reference, unfinished)
    if practice == "adjusted" and unfinished != "worst rank":
        tests = lap_time_model(laps, reference, rng, wanted=[condition])
        return LapTimeTest(unfinished, practice, tests[0], found)
    if practice == "balanced":
        times = times.assign(value=without_place(times, times["value"]))
    logs = _wide(times, laps, condition, reference)
    if practice == "balanced" and imbalance(timed, condition, reference):
        differences = (logs[condition] - logs[reference]).to_numpy()
        logs[condition] = logs[reference] + restored(differences, *less_places(timed))
    test = _signed(logs, laps, condition, reference, unfinished)
    test = replace(
        test,
        quantity="log of the ratio of lap times, condition / reference",
        method=f"{test.method}, of log ratios{_less_place(practice)}" if test.method else "",
    )
    nonzero = int(test.n - sum(_zeros(logs, laps, condition, reference, unfinished)))
    return LapTimeTest(unfinished, practice, test, found, smallest_p(nonzero))


def _less_place(practice: Practice) -> str:
    return " less each place's mean" if practice == "balanced" else ""


def _wide(times: pd.DataFrame, laps: pd.DataFrame, condition: str, reference: str) -> pd.DataFrame:
    """Return each person's mean value in two conditions: participants by conditions."""
    people = pd.Index(sorted(laps["participant"].unique()))
    pair = pd.Index([condition, reference])
    row, column = (
        people.get_indexer(pd.Index(times["participant"])),
        pair.get_indexer(pd.Index(times["condition"])),
    )
    used = column >= 0
    sums, counts = np.zeros((2, len(people), 2))
    np.add.at(sums, (row[used], column[used]), times["value"].to_numpy()[used])
    np.add.at(counts, (row[used], column[used]), 1)
    means = np.divide(sums, counts, out=np.full_like(sums, np.nan), where=counts > 0)
    return pd.DataFrame(means, index=people, columns=pair)


def _differences(
    wide: pd.DataFrame, laps: pd.DataFrame, condition: str, reference: str, unfinished: Unfinished
) -> pd.Series:
    differences = wide[condition] - wide[reference]
    if unfinished != "worst rank":
        return differences
    return worst_differences(differences, laps, condition, reference)


def _signed(
    wide: pd.DataFrame, laps: pd.DataFrame, condition: str, reference: str, unfinished: Unfinished
) -> TestResult:
    return signed_rank(_differences(wide, laps, condition, reference, unfinished))


def _zeros(
    wide: pd.DataFrame, laps: pd.DataFrame, condition: str, reference: str, unfinished: Unfinished
) -> pd.Series:
    return _differences(wide, laps, condition, reference, unfinished) == 0
