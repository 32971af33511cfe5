"""Participants flow: planned, recorded, excluded and why, analysed. The arithmetic adds up."""

from dataclasses import dataclass

import pandas as pd

from analysis.frames import StudyFrames, as_frame, excluded, refused
from analysis.left_out import left_out


@dataclass(frozen=True, slots=True)
class Flow:
    """How many people there were at each stage.

    Attributes
    ----------
    planned
        As in the protocol, or as many as were recorded if that is more; None where a study from
        elsewhere does not give how many were planned.
    not_run, failed
        Planned sessions that were not begun, and sessions that broke off with an error.
    recorded
        Sessions with a record.
    refused
        Recorded participants without consent.
    consent_unknown
        Analysed participants without a recorded consent or refusal.
    excluded
        Recorded participants with consent who are excluded by a rule, by reason.
    analysed
        The rest.
    completed
        Of these, who finished every planned lap, practice apart.
    laps
        One row per condition: laps planned, not driven, unfinished by reason, finished, and how
        many of the finished ones have no lap time.
    withdrawals
        One row per lap in which a participant left: participant, lap, condition, and why, in the
        participant's words. Participants who refused consent are not in it.
    left_out
        What the tables hold that no analysis can use, in words; empty for our own studies.
    """

    planned: int | None
    not_run: int
    failed: int
    recorded: int
    refused: int
    consent_unknown: int
    excluded: dict[str, int]
    analysed: int
    completed: int
    laps: pd.DataFrame
    withdrawals: pd.DataFrame
    left_out: tuple[str, ...]


def participants_flow(frames: StudyFrames) -> Flow:
    """Count the participants at every stage."""
    people = frames.everybody
    no = refused(people)
    out = excluded(people) & ~no
    reasons = people.loc[out, "exclusion_reason"].fillna("no reason recorded").value_counts()
    recorded, failed = len(people), len(frames.study.failed())
    declared = frames.study.header.planned_participants
    planned = None if declared is None else max(declared, recorded + failed)
    return Flow(
        planned=planned,
        not_run=0 if planned is None else planned - recorded - failed,
        failed=failed,
        recorded=recorded,
        refused=int(no.sum()),
        consent_unknown=int(frames.participants["consented"].isna().sum()),
        excluded={str(reason): int(n) for reason, n in sorted(reasons.items())},
        analysed=len(frames.participants),
        completed=_completed(frames),
        laps=lap_flow(frames),
        withdrawals=withdrawals(frames),
        left_out=left_out(frames),
    )


def lap_flow(frames: StudyFrames) -> pd.DataFrame:
    """Return one row per condition: laps planned = finished + unfinished + not driven.

    ``finished_without_time`` counts laps that are among the finished ones, too.
    """
    planned = _planned(frames)
    rows = []
    for condition in frames.conditions:
        laps = frames.laps[frames.laps["condition"] == condition]
        done = laps["completed"].astype(bool)
        unfinished = laps[~done]
        reasons = unfinished["end_reason"].fillna("no reason recorded")
        expected = max(int(planned.get(condition, 0)) * len(frames.participants), len(laps))
        rows.append(
            {
                "condition": condition,
                "planned": expected,
                "finished": len(laps) - len(unfinished),
                "time_limit": int((reasons == "time_limit").sum()),
                "withdrew": int((reasons == "withdrew").sum()),
                "unfinished_otherwise": int((~reasons.isin(["time_limit", "withdrew"])).sum()),
                "not_driven": expected - len(laps),
                "finished_without_time": int(laps.loc[done, "lap_time_s"].isna().sum()),
            }
        )
    return pd.DataFrame(rows)


def _planned(frames: StudyFrames) -> pd.Series:
    """Return how many laps of each condition a participant is to drive, practice apart."""
    laps = frames.study.protocol.laps
    return pd.Series([lap.condition for lap in laps if not lap.practice]).value_counts()


def _completed(frames: StudyFrames) -> int:
    """Return how many people finished as many laps of every condition as were planned."""
    laps = frames.laps[frames.laps["completed"].astype(bool)]
    finished = pd.crosstab(laps["participant"], laps["condition"])
    planned = _planned(frames)
    enough = finished.reindex(columns=planned.index, fill_value=0) >= planned
    return int(enough.all(axis=1).sum())


def withdrawals(frames: StudyFrames) -> pd.DataFrame:
    """Return one row per lap that ended by a withdrawal, practice laps and the excluded included.

    Returns
    -------
    pandas.DataFrame
        Columns participant, lap, condition and withdrawal (the words; missing if there are none).
    """
    laps = as_frame(frames.study.laps)
    people = frames.everybody
    consented = set(people.loc[~refused(people), "participant"])
    left = laps[(laps["end_reason"] == "withdrew") & laps["participant"].isin(consented)]
    wanted = left[["participant", "lap", "condition", "withdrawal"]]
    return wanted.sort_values(["participant", "lap"], ignore_index=True)
