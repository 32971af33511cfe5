"""Everything that is computed about a study, before anything is written about it."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import pandas as pd

from analysis.comparisons import (
    PairedComparison,
    declared_results,
    item_comparisons,
    lap_time_comparisons,
)
from analysis.explain.policies import Policies, policies
from analysis.flow import Flow, participants_flow
from analysis.frames import StudyFrames, on_own_course, study_frames
from analysis.group_comparisons import GroupComparison
from analysis.groups import GroupResults, group_results
from analysis.lap_records import LapRecords, read_laps
from analysis.live_quality import LiveQuality, live_quality
from analysis.maps import participant_maps, plan_grid
from analysis.outcome_exclusion import without_the_rule
from analysis.place import with_place
from analysis.practice import practice_table
from analysis.processes import HERE, Processes
from analysis.randomness import generator
from analysis.registration import Registered, registered_plan
from analysis.roles import first, reference_condition
from analysis.side_by_side import SideBySide, side_by_side
from analysis.stats.carry_over import carry_over
from analysis.stats.map_overlap import map_overlap
from analysis.stats.mixed_model import lap_time_model
from analysis.stats.own_contrasts import own_contrasts
from analysis.stats.result import TestResult
from analysis.tables.against_paper import paper_table
from analysis.tables.measures import measure_table
from analysis.tables.reliability import reliability_table
from analysis.tables.scales import scale_table
from analysis.tables.sections import section_table
from analysis.tables.survey import survey_table
from analysis.unfinished import NobodyFinished, nobody_finished
from protocols.instrument import Instrument
from protocols.record.reader import Study

Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class SurveyResults:
    """One questionnaire: answers, items compared between conditions, composite scores."""

    instrument: Instrument
    table: pd.DataFrame
    comparisons: tuple[PairedComparison, ...]
    scales: pd.DataFrame


@dataclass(frozen=True, slots=True)
class StudyResults:
    """What was found.

    Attributes
    ----------
    frames
        The study's tables.
    flow
        Who took part and who is analysed.
    records
        Measures of every analysed lap, and its pooled steps.
    unfinished
        Conditions in which nobody finished a lap.
    declared
        Comparisons the protocol declares within participants.
    between
        Comparisons it declares between groups of them.
    without_rule
        The same without the rule ``min_completed_laps``; empty where that rule excludes no
        one.
    groups
        Groups of participants compared; None for a study without groups.
    registered
        What was registered against what was done; None for a study without a registration.
    carry_over
        How much a condition changes the next lap; empty where the design does not identify it.
    lap_times
        Lap times of every two conditions, declared or not.
    model
        Mixed model of log lap times: every condition against the reference condition.
    contrasts
        The same contrasts from each participant's own laps, each with its own spread.
    practice
        What remains of the model's contrasts under plausible practice; see ``analysis.practice``.
    overlap
        Demonstrator's and model's assistance maps compared; None unless there are both.
    surveys
        One per instrument.
    policies
        What the models have learnt about helping; None in a study without a learnt model of ours.
    live
        How good the sessions with living people were; None where there are none.
    people
        Living and synthetic people side by side; None where there is one kind only.
    measures, sections, reliability, paper
        Tables; see ``analysis.tables``.
    """

    frames: StudyFrames
    flow: Flow
    records: LapRecords
    unfinished: tuple[NobodyFinished, ...]
    declared: tuple[PairedComparison, ...]
    between: tuple[GroupComparison, ...]
    without_rule: tuple[PairedComparison, ...]
    carry_over: tuple[TestResult, ...]
    groups: GroupResults | None
    registered: Registered | None
    lap_times: tuple[PairedComparison, ...]
    model: tuple[TestResult, ...]
    contrasts: tuple[TestResult, ...]
    practice: pd.DataFrame
    overlap: TestResult | None
    surveys: tuple[SurveyResults, ...]
    policies: Policies | None
    live: LiveQuality | None
    people: SideBySide | None
    measures: pd.DataFrame
    sections: pd.DataFrame
    reliability: pd.DataFrame
    paper: pd.DataFrame


def analyse(
    study: Study,
    progress: Progress | None = None,
    others: Processes = HERE,
    beside: Study | None = None,
) -> StudyResults:
    """Compute everything.

    Parameters
    ----------
    study
        The study.
    progress
        Told in a few words what is being done.
    others
        Processes that take part of the work.
    beside
        Another study, whose people are shown beside this one's; None for none.

    Raises
    ------
    InputError
        When the table of participants or of laps cannot be used, or the other study has no
        condition in common with this one.
    """
    frames = study_frames(study)
    people = side_by_side(frames, None if beside is None else study_frames(beside))
    # Whatever needs no lap's steps first: other processes do it while this one reads them.
    surveys = [others.later(_survey, frames, instrument) for instrument in study.instruments]
    learnt = others.later(policies, study, _drivers(study))
    records = read_laps(frames, progress, others)
    if progress is not None:
        progress("Comparing conditions")
    lap_times = lap_time_comparisons(frames)
    model, contrasts = _model(frames), _contrasts(frames)
    answers = tuple(survey() for survey in surveys)
    measures = measure_table(frames, records)
    declared, between = declared_results(frames)
    return StudyResults(
        frames=frames,
        flow=participants_flow(frames),
        records=records,
        unfinished=nobody_finished(study),
        declared=declared,
        between=between,
        without_rule=without_the_rule(frames),
        carry_over=_carry_over(frames),
        groups=group_results(frames),
        registered=registered_plan(frames, declared, between),
        lap_times=lap_times,
        model=model,
        contrasts=contrasts,
        practice=practice_table(frames, contrasts),
        overlap=_overlap(frames, records),
        surveys=answers,
        policies=learnt(),
        live=live_quality(frames),
        people=people,
        measures=measures,
        sections=section_table(frames, records),
        reliability=reliability_table(frames, records),
        paper=paper_table(frames, lap_times, [s.table for s in answers], measures),
    )


def _drivers(study: Study) -> list[str]:
    """Return who drove a lap, in the order of the table of laps."""
    return list(dict.fromkeys(study.laps.to_pandas()["participant"].astype(str)))


def _model(frames: StudyFrames) -> tuple[TestResult, ...]:
    reference = reference_condition(frames.parts)
    if reference is None:
        return ()
    laps = with_place(frames.laps)
    found = lap_time_model(laps, reference, generator(frames.study, "mixed model"))
    return _in_order(frames, found, f"{{}} against {reference}")


def _carry_over(frames: StudyFrames) -> tuple[TestResult, ...]:
    reference = reference_condition(frames.parts)
    if reference is None:
        return ()
    found = carry_over(with_place(frames.laps), reference)
    return _in_order(frames, found, f"after {{}} against after {reference}")


def _contrasts(frames: StudyFrames) -> tuple[TestResult, ...]:
    reference = reference_condition(frames.parts)
    if reference is None:
        return ()
    found = own_contrasts(frames.by_place, reference)
    return _in_order(frames, found, f"{{}} against {reference}")


def _in_order(
    frames: StudyFrames, found: Sequence[TestResult], named: str
) -> tuple[TestResult, ...]:
    """Return tests of conditions in the protocol's order, whichever was driven first."""
    at = {named.replace("{}", condition): i for i, condition in enumerate(frames.conditions)}
    return tuple(sorted(found, key=lambda one: at[one.name]))


def _overlap(frames: StudyFrames, records: LapRecords) -> TestResult | None:
    pair = first(frames.parts, "demonstrator"), first(frames.parts, "model")
    if None in pair:
        return None
    steps = on_own_course(frames, records.steps)
    seen = _seen(steps, list(frames.participants["participant"]), pair)
    grid = plan_grid(frames.study.course)
    maps = [participant_maps(steps[steps["condition"] == c], seen, grid) for c in pair]
    found = map_overlap(maps[0], maps[1], generator(frames.study, "map overlap"))
    unseen = len(frames.participants) - len(seen)
    people_left_out = "1 participant" if unseen == 1 else f"{unseen} participants"
    note = f"{people_left_out} without recorded steps in both conditions left out"
    return replace(found, notes=(*found.notes, note)) if unseen else found


def _seen(
    steps: pd.DataFrame, people: Sequence[str], conditions: Iterable[str | None]
) -> list[str]:
    """Return the participants with known position and assistance in every condition."""
    known = steps[steps[["helped", "x_m", "y_m"]].notna().all(axis=1)]
    there = [set(known.loc[known["condition"] == c, "participant"].unique()) for c in conditions]
    return [who for who in people if all(who in place for place in there)]


def _survey(frames: StudyFrames, instrument: Instrument) -> SurveyResults:
    items = [item.id for item in instrument.items if item.scored]
    return SurveyResults(
        instrument=instrument,
        table=survey_table(frames, instrument),
        comparisons=item_comparisons(frames, instrument.name, items),
        scales=scale_table(frames, instrument),
    )
