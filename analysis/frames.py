"""The study's tables as data frames, and which rows an analysis may use."""

import os
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import pandas as pd
import pyarrow as pa

from analysis.exclusions import Exclusions, exclusions_of
from analysis.roles import Part, condition_roles
from protocols.files.errors import InputError
from protocols.record.reader import Study, off_scale
from protocols.record.tables import SURVEY_SCHEMA


@dataclass(frozen=True, slots=True)
class StudyFrames:
    """The tables of a study.

    Attributes
    ----------
    study
        Where they come from.
    parts
        The analysed conditions and their roles.
    everybody
        One row per participant, whether analysed or not; excluded as recorded, else as the
        protocol's rules have it.
    exclusions
        How it is known who is excluded.
    participants
        One row per participant who is not excluded by a rule and did not refuse consent.
    laps
        Their laps in the analysed conditions, practice left out; finished or not. Only a finished
        one has a lap time.
    surveys
        Their answers, missing ones as NaN: one of each person to each item in each condition. Where
        a condition was driven more than once, the last answer given counts.
    answers
        The answers of all participants as they were recorded; those off their scale as NaN.
    unread
        What of the answers could not be read, in words.
    """

    study: Study
    parts: tuple[Part, ...]
    everybody: pd.DataFrame
    participants: pd.DataFrame
    laps: pd.DataFrame
    surveys: pd.DataFrame
    answers: pd.DataFrame
    exclusions: Exclusions
    unread: tuple[str, ...] = ()

    @property
    def conditions(self) -> tuple[str, ...]:
        """The analysed conditions, in the order of their first lap."""
        return tuple(part.condition for part in self.parts)

    @property
    def practised(self) -> bool:
        """Whether any lap is practice."""
        return bool(practised(as_frame(self.study.laps)).any())

    @property
    def by_place(self) -> pd.DataFrame:
        """The laps with their places in the session for numbers, as models of time take them."""
        numbers = as_frame(self.study.laps)["lap"].astype(int)
        taken = places(numbers, len(self.study.protocol.laps))
        return self.laps.assign(lap=self.laps["lap"].map(dict(zip(numbers, taken, strict=True))))

    @property
    def synthetic(self) -> bool:
        """Whether any analysed participant is synthetic."""
        return bool((self.participants["kind"] == "synthetic").any())


def study_frames(study: Study, keep: Iterable[str] = ()) -> StudyFrames:
    """Return the tables of a study, and those who are analysed.

    Parameters
    ----------
    study
        The study.
    keep
        Participants who are analysed although a rule excludes them: for an analysis that shows
        what the rule does.
    """
    all_laps = as_frame(study.laps)
    exclusions = exclusions_of(study, all_laps[~practised(all_laps)])
    everybody = as_frame(study.participants).assign(
        excluded=exclusions.excluded, exclusion_reason=pd.Series(exclusions.reasons, dtype=object)
    )
    out = excluded(everybody) & ~everybody["participant"].isin(list(keep))
    kept = everybody[~out & ~refused(everybody)]
    parts = condition_roles(study.protocol)
    laps = counted_laps(study, kept["participant"])
    laps = laps[laps["condition"].isin([part.condition for part in parts])]
    # Whatever stands there: a lap that was not finished has no lap time.
    laps = laps.assign(
        lap_time_s=laps["lap_time_s"].where(laps["completed"].astype(bool)),
    )
    answers, unread = _answers(study)
    counted = counted_answers(study, answers, kept["participant"])
    return StudyFrames(
        study=study,
        parts=parts,
        everybody=everybody,
        participants=kept.reset_index(drop=True),
        laps=laps.reset_index(drop=True),
        surveys=last_answers(counted).reset_index(drop=True),
        answers=answers,
        exclusions=exclusions,
        unread=unread,
    )


def on_own_course(frames: StudyFrames, steps: pd.DataFrame) -> pd.DataFrame:
    """Return the steps of those who drove the study's own course: a group may have driven another.

    Parameters
    ----------
    frames
        The study.
    steps
        With a column ``participant``.
    """
    elsewhere = tuple(frames.study.header.group_courses)
    if not elsewhere:
        return steps
    people = frames.everybody
    gone = people.loc[people["group"].isin(elsewhere), "participant"]
    return steps[~steps["participant"].isin(gone)]


def counted_laps(study: Study, participants: Iterable[str]) -> pd.DataFrame:
    """Return the laps of some people as they were recorded, practice laps left out."""
    laps = as_frame(study.laps)
    return laps[laps["participant"].isin(list(participants)) & ~practised(laps)]


def counted_answers(
    study: Study, answers: pd.DataFrame, participants: Iterable[str]
) -> pd.DataFrame:
    """Return some people's answers, those after practice left out."""
    laps = as_frame(study.laps)
    practice = laps.loc[practised(laps), ["participant", "lap"]]
    driven = pd.MultiIndex.from_frame(answers[["participant", "lap"]])
    after_practice = driven.isin(pd.MultiIndex.from_frame(practice))
    return answers[answers["participant"].isin(list(participants)) & ~after_practice]


def _answers(study: Study) -> tuple[pd.DataFrame, tuple[str, ...]]:
    """Return the answers that can be read, and what is wrong with the others, in words."""
    try:
        answers = as_frame(study.surveys)
    except InputError as error:
        return as_frame(SURVEY_SCHEMA.empty_table()), (within(study, error),)
    wrong = dict(off_scale(study))
    if not wrong:
        return answers, ()
    answers["response"] = answers["response"].astype("float64")
    answers.loc[list(wrong), "response"] = np.nan
    more = f" (and {len(wrong) - 1} more)" if len(wrong) > 1 else ""
    return answers, (within(study, next(iter(wrong.values()))) + more,)


def last_answers(answers: pd.DataFrame) -> pd.DataFrame:
    """Return one answer of each person to each item in each condition: the last one given.

    Answers on a scale are not averaged: between "agree" and "disagree" there need not be a middle.
    """
    asked = ["participant", "condition", "instrument", "item"]
    in_order = answers.assign(given=answers["response"].notna()).sort_values(["given", "lap"])
    return answers.loc[in_order.drop_duplicates(asked, keep="last").index].sort_index()


def practised(laps: pd.DataFrame) -> pd.Series:
    """Return which laps are practice; where they do not say so, the reader has filled it in."""
    practice: pd.Series = laps["practice"].astype(bool)
    return practice


def places(numbers: pd.Series, planned: int) -> pd.Series:
    """Return each lap's place in the session: its number, or its rank where numbers leap.

    Parameters
    ----------
    numbers
        Of every lap of the study.
    planned
        How many laps are planned. Numbers beyond are no places: 10, 20, 30 are three laps.

    Examples
    --------
    >>> places(pd.Series([10, 20, 10, 30]), 3).tolist()
    [0, 1, 0, 2]
    """
    if numbers.max() <= planned:
        return numbers
    return numbers.rank(method="dense").astype(int) - 1


def as_frame(table: pa.Table) -> pd.DataFrame:
    """Return a table as a frame; whole numbers with gaps become floats with NaN."""
    # Threads cost more than they save in tables of a few hundred rows; there are thousands of them.
    frame: pd.DataFrame = table.to_pandas(use_threads=False)
    return frame


def excluded(participants: pd.DataFrame) -> pd.Series:
    """Return who is excluded, of ``StudyFrames.everybody``."""
    return participants["excluded"].astype(bool)


def refused(participants: pd.DataFrame) -> pd.Series:
    """Return who refused consent; a consent that was not recorded is not a refusal."""
    no: pd.Series = participants["consented"].eq(other=False)
    return no


def within(study: Study, fault: InputError | str) -> str:
    """Return what is wrong with a file, its path from the study's folder: a report may be moved."""
    return str(fault).replace(f"{study.folder}{os.sep}", "")
