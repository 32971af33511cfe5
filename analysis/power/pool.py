"""The people that studies are drawn from, as the declared analyses see them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from analysis.estimands import timed_laps
from analysis.frames import StudyFrames
from analysis.outcomes import outcome_of
from analysis.place import Practice, practice_of, with_place
from protocols.declared import Comparison
from protocols.files.errors import InputError
from protocols.order import group_of, in_words, laps_of, places
from protocols.study import StudyProtocol

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Pool:
    """People as arrays.

    Attributes
    ----------
    conditions
        The analysed conditions.
    log_times, places
        Shape (people, conditions): log lap times in log s, and the laps' places; NaN where missing.
    differences
        Shape (people,) for each analysis: condition minus reference in the outcome's unit (s for
        lap times); of a comparison of groups in one condition, the outcome itself.
    reference_means
        For each analysis the mean of the reference, in the outcome's unit; of a comparison of
        groups in one condition, the second group's mean.
    orders
        Shape (people,): the order each drove, in words.
    groups
        Shape (people,): each one's group, "" for none.
    """

    conditions: tuple[str, ...]
    log_times: Array
    places: Array
    differences: Mapping[str, Array]
    reference_means: Mapping[str, float]
    orders: NDArray[np.str_]
    groups: NDArray[np.str_]

    @property
    def size(self) -> int:
        """Number of people."""
        return len(self.log_times)

    def columns(self, comparison: Comparison) -> tuple[int, ...]:
        """Return the columns of an analysis's condition and, where it has one, its reference."""
        at = {name: i for i, name in enumerate(self.conditions)}
        return tuple(at[name] for name in comparison.conditions)


def pool_of(frames: StudyFrames, analyses: Sequence[Comparison]) -> Pool:
    """Return the people of a study, as the declared analyses see them.

    Parameters
    ----------
    frames
        A study, recorded or simulated.
    analyses
        What is declared; where a comparison of lap times counts unfinished laps in another way than
        leaving them out, its log times are taken so.

    Raises
    ------
    InputError
        When the study lacks a condition or a group that an analysis compares.
    """
    for comparison in analyses:
        for condition in comparison.conditions:
            if condition not in frames.conditions:
                have = ", ".join(frames.conditions)
                raise InputError(
                    f"{frames.study.folder}: nobody drove '{condition}', which "
                    f"'{comparison.name}' compares; allowed: a pool with {have}"
                )
    people = sorted(frames.participants["participant"])
    counted = {a.unfinished for a in analyses if a.outcome == "lap_time_s"}
    laps = with_place(timed_laps(frames, "limit" if "limit" in counted else "complete pairs"))
    wide = {c.name: outcome_of(frames, c) for c in analyses}
    groups = _groups(frames, people, analyses)
    return Pool(
        conditions=frames.conditions,
        log_times=np.log(_table(laps, "lap_time_s", people, frames.conditions)),
        places=_table(laps, "place", people, frames.conditions),
        differences={c.name: _difference(wide[c.name], c) for c in analyses},
        reference_means={c.name: _reference_mean(wide[c.name], c, groups) for c in analyses},
        orders=_orders(laps, people),
        groups=groups,
    )


def _difference(wide: pd.DataFrame, comparison: Comparison) -> Array:
    value = wide[comparison.condition]
    if comparison.reference is not None:
        value = value - wide[comparison.reference]
    return np.asarray(value.to_numpy(), dtype=np.float64)


def _reference_mean(wide: pd.DataFrame, comparison: Comparison, groups: NDArray[np.str_]) -> float:
    if comparison.reference is not None:
        return float(wide[comparison.reference].mean())
    second = groups == (comparison.groups or ("", ""))[1]
    return float(wide.loc[second, comparison.condition].mean())


def _groups(
    frames: StudyFrames, people: list[str], analyses: Sequence[Comparison]
) -> NDArray[np.str_]:
    """Return everyone's group; refuse a pool without the groups that are compared."""
    of = frames.everybody.set_index("participant")["group"].reindex(people)
    groups = np.asarray(of.fillna("").to_numpy(), dtype=np.str_)
    for comparison in analyses:
        for name in comparison.groups or ():
            if name not in groups:
                have = ", ".join(sorted(set(groups) - {""})) or "no groups"
                raise InputError(
                    f"{frames.study.folder}: nobody was in group '{name}', which "
                    f"'{comparison.name}' compares; allowed: a pool with that group (it has {have})"
                )
    return groups


def _table(laps: pd.DataFrame, column: str, people: list[str], conditions: Sequence[str]) -> Array:
    wide = laps.pivot_table(index="participant", columns="condition", values=column)
    table: Array = wide.reindex(index=people, columns=list(conditions)).to_numpy(dtype=np.float64)
    return table


def _orders(laps: pd.DataFrame, people: list[str]) -> NDArray[np.str_]:
    ordered = laps.sort_values(["participant", "place"])
    said = ordered.groupby("participant")["condition"].agg(" > ".join)
    return np.asarray(said.reindex(people).fillna("").to_numpy(), dtype=np.str_)


def planned_practice(protocol: StudyProtocol, analysis: Comparison, n: int) -> Practice:
    """Return what a report could do about practice if n participants drove every lap as planned."""
    rows = [
        (number, lap.condition, place)
        for number in range(1, n + 1)
        for laps in [laps_of(protocol, number, 0)]
        for lap, place in zip(laps, places(laps), strict=True)
        if place is not None
    ]
    planned = pd.DataFrame(rows, columns=["participant", "condition", "place"])
    return practice_of(planned, *analysis.pair)


def wanted_orders(protocol: StudyProtocol, n: int, seed: int) -> list[tuple[str, str]]:
    """Return the groups ("" for none) and orders, in words, of a study's first n participants."""
    return [
        (group_of(protocol, number, seed) or "", in_words(laps_of(protocol, number, seed)))
        for number in range(1, n + 1)
    ]
