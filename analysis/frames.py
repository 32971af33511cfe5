"""The study's tables as data frames, and which rows an analysis may use."""

from dataclasses import dataclass

import pandas as pd
import pyarrow as pa

from analysis.roles import Part, cast
from protocols.record.reader import Study


@dataclass(frozen=True, slots=True)
class StudyFrames:
    """The tables of a study.

    Attributes
    ----------
    study
        Where they come from.
    parts
        The analysed conditions and their parts.
    everybody
        One row per participant, whether analysed or not.
    participants
        One row per participant whom no rule excludes and who did not refuse consent.
    laps
        Their laps, practice left out; finished or not.
    surveys
        Their answers, missing ones as NaN.
    """

    study: Study
    parts: tuple[Part, ...]
    everybody: pd.DataFrame
    participants: pd.DataFrame
    laps: pd.DataFrame
    surveys: pd.DataFrame

    @property
    def conditions(self) -> tuple[str, ...]:
        """The analysed conditions, in the order of their first lap."""
        return tuple(part.condition for part in self.parts)


def study_frames(study: Study) -> StudyFrames:
    """Return the tables of a study, and those who are analysed."""
    everybody = as_frame(study.participants)
    kept = everybody[~excluded(everybody) & ~refused(everybody)]
    laps = as_frame(study.laps)
    surveys = as_frame(study.surveys)
    ids = set(kept["participant"])
    practice = laps["practice"].fillna(value=False).astype(bool)
    laps = laps[laps["participant"].isin(ids) & ~practice]
    return StudyFrames(
        study=study,
        parts=cast(study.protocol),
        everybody=everybody,
        participants=kept.reset_index(drop=True),
        laps=laps.reset_index(drop=True),
        surveys=surveys[surveys["participant"].isin(ids)].reset_index(drop=True),
    )


def as_frame(table: pa.Table) -> pd.DataFrame:
    """Return a table as a frame; whole numbers with gaps become floats with NaN."""
    frame: pd.DataFrame = table.to_pandas()
    return frame


def excluded(participants: pd.DataFrame) -> pd.Series:
    """Return whom the protocol's rules exclude."""
    return participants["excluded"].fillna(value=False).astype(bool)


def refused(participants: pd.DataFrame) -> pd.Series:
    """Return who refused consent; a consent nobody recorded is not a refusal."""
    consented: pd.Series = participants["consented"].fillna(value=True).astype(bool)
    return ~consented
