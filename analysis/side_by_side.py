"""Living and synthetic people side by side: the same conditions, one study or two."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

from analysis.frames import StudyFrames
from analysis.stats.describe import describe
from protocols.files.errors import InputError

PEOPLE = {"live": "living", "synthetic": "synthetic", "scripted": "scripted"}
"""What people of each kind are called."""


@dataclass(frozen=True, slots=True)
class SideBySide:
    """People of several kinds in the same conditions.

    Attributes
    ----------
    groups
        What the groups are called, in the order in which they are shown.
    laps
        Their laps: group, participant, lap, condition, completed, lap_time_s, duration_s, and
        ``here``, whether they are of this study and not of the one beside it.
    times
        One row per condition and group: laps, unfinished ones, mean, sd and median lap time.
    answers
        One row per instrument, item, condition and group: answered, and percent who agree.
    other
        What the other study is called; None where one study holds all of them.
    same_course
        Whether both studies drove the same course.
    """

    groups: tuple[str, ...]
    laps: pd.DataFrame
    times: pd.DataFrame
    answers: pd.DataFrame
    other: str | None = None
    same_course: bool = True


def side_by_side(frames: StudyFrames, beside: StudyFrames | None = None) -> SideBySide | None:
    """Return the groups of people in a study, and in one beside it; None for a single group.

    Parameters
    ----------
    frames
        The study.
    beside
        Another one, whose people stand beside this one's.

    Raises
    ------
    InputError
        When the two studies have no condition in common.
    """
    studies = [frames] if beside is None else [frames, beside]
    shared = [c for c in frames.conditions if all(c in other.conditions for other in studies)]
    if beside is not None and not shared:
        raise InputError(
            f"{beside.study.folder}: has no condition of {frames.study.folder}; "
            f"allowed: a study with one of {', '.join(frames.conditions)}"
        )
    laps = _grouped(studies, [one.laps for one in studies])
    groups = tuple(dict.fromkeys(laps["group"]))
    if len(groups) < 2:
        return None
    laps = laps[laps["condition"].isin(shared)].reset_index(drop=True)
    answers = _grouped(studies, [one.surveys for one in studies])
    return SideBySide(
        groups=groups,
        laps=laps,
        times=_times(laps, shared, groups),
        answers=_answers(frames, answers, shared, groups),
        other=None if beside is None else beside.study.protocol.name,
        same_course=beside is None or beside.study.course == frames.study.course,
    )


def _grouped(studies: list[StudyFrames], rows: Sequence[pd.DataFrame]) -> pd.DataFrame:
    """Return every study's rows with the group of their participant: the kind.

    Synthetic people of two studies are two groups.
    """
    kinds = [set(frames.participants["kind"]) for frames in studies]
    twice = set.intersection(*kinds) if len(kinds) > 1 else set()
    found = []
    for place, (frames, own) in enumerate(zip(studies, rows, strict=True)):
        where = "beside" if place else "this study"
        names = {k: f"{word} ({where})" if k in twice else word for k, word in PEOPLE.items()}
        kind = frames.participants.set_index("participant")["kind"]
        group = own["participant"].map(kind).map(names)
        found.append(own.assign(group=group, here=not place))
    return pd.concat(found, ignore_index=True)


def _times(laps: pd.DataFrame, conditions: list[str], groups: tuple[str, ...]) -> pd.DataFrame:
    rows = []
    for condition in conditions:
        for group in groups:
            own = laps[(laps["condition"] == condition) & (laps["group"] == group)]
            found = describe(own["lap_time_s"])
            rows.append(
                {"condition": condition, "people": group, "laps": len(own),
                 "unfinished": int((~own["completed"].astype(bool)).sum()), "n": found.n,
                 "mean": found.mean, "sd": found.sd, "median": found.median}
            )  # fmt: skip
    return pd.DataFrame(rows)


def _answers(
    frames: StudyFrames, answers: pd.DataFrame, conditions: list[str], groups: tuple[str, ...]
) -> pd.DataFrame:
    rows: list[dict[str, Any]] = []
    for instrument in frames.study.instruments:
        for item in instrument.items:
            if item.answer != "point" or not item.scored:
                continue
            own = answers[
                (answers["instrument"] == instrument.name)
                & (answers["item"] == item.id)
                & answers["response"].notna()
            ]
            for condition in conditions:
                for group in groups:
                    given = own.loc[
                        (own["condition"] == condition) & (own["group"] == group), "response"
                    ]
                    if given.empty:
                        continue
                    agreeing = 100.0 * float((given >= instrument.agreement_from).mean())
                    rows.append(
                        {"instrument": instrument.name, "item": item.id, "text": item.text,
                         "condition": condition, "people": group, "answered": len(given),
                         "agree_percent": agreeing}
                    )  # fmt: skip
    columns = ["instrument", "item", "text", "condition", "people", "answered", "agree_percent"]
    return pd.DataFrame(rows, columns=columns)
