"""Comparisons between groups of participants, and the flow of each group."""

from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames, excluded, refused
from analysis.place import with_place
from analysis.roles import reference_condition
from analysis.stats.holm import holm
from analysis.stats.mixed_model import indicator, model_result
from analysis.stats.random_intercept import fit_random_intercept
from analysis.stats.rank_sum import rank_sum
from analysis.stats.result import TestResult


@dataclass(frozen=True, slots=True)
class GroupResults:
    """What groups differ in.

    Attributes
    ----------
    flow
        One row per group: group, recorded, refused, excluded, reasons (of the exclusions, with
        how many people each, in words), analysed.
    tests
        Log lap times of each condition between two groups, and the contrast of each condition with
        the reference between them (group x condition), each by the rank-sum test.
    p_holm
        Of each test, after Holm over all of them.
    models
        The same two kinds of contrast in a mixed model, with Kenward and Roger's degrees of
        freedom: those of people, where people are compared.
    """

    flow: pd.DataFrame
    tests: tuple[TestResult, ...]
    p_holm: tuple[float, ...]
    models: tuple[TestResult, ...]


def group_results(frames: StudyFrames) -> GroupResults | None:
    """Compare the groups of a study; None for a study without groups."""
    names = tuple(frames.study.protocol.groups)
    if not names:
        return None
    group = group_by_participant(frames)
    laps = with_place(frames.laps).dropna(subset=["lap_time_s"])
    laps = laps.assign(group=laps["participant"].map(group),
                       log_time=np.log(laps["lap_time_s"].to_numpy(dtype=np.float64)))  # fmt: skip
    pairs = [(other, names[0]) for other in names[1:]]
    tests = tuple(t for pair in pairs for t in _tests(frames, laps, *pair))
    return GroupResults(
        flow=_flow(frames, names),
        tests=tests,
        p_holm=holm([t.p for t in tests]) if tests else (),
        models=tuple(t for pair in pairs for t in group_model(frames, laps, *pair)),
    )


def group_by_participant(frames: StudyFrames) -> pd.Series:
    """Return everybody's group, by participant."""
    group: pd.Series = frames.everybody.set_index("participant")["group"]
    return group


def _flow(frames: StudyFrames, names: tuple[str, ...]) -> pd.DataFrame:
    people = frames.everybody
    no, out = refused(people), excluded(people) & ~refused(people)
    rows = []
    for name in names:
        mine = people["group"] == name
        counts = (int(mine.sum()), int((mine & no).sum()), int((mine & out).sum()))
        why = people.loc[mine & out, "exclusion_reason"].fillna("no reason recorded")
        reasons = "; ".join(f"{reason}: {n}" for reason, n in sorted(why.value_counts().items()))
        rows.append((name, *counts, reasons, counts[0] - counts[1] - counts[2]))
    columns = ["group", "recorded", "refused", "excluded", "reasons", "analysed"]
    return pd.DataFrame(rows, columns=columns)


def _tests(frames: StudyFrames, laps: pd.DataFrame, group: str, reference: str) -> list[TestResult]:
    """Test each condition, and each contrast with the reference condition, between two groups."""
    wide = laps.pivot_table(index="participant", columns="condition", values="log_time")
    of = laps.drop_duplicates("participant").set_index("participant")["group"].reindex(wide.index)
    against = reference_condition(frames.parts)
    found = []
    for condition in (c for c in frames.conditions if c in wide):
        values = {f"{condition}: {group} against {reference}": wide[condition]}
        if against in wide and condition != against:
            name = f"{condition} against {against}: {group} against {reference}"
            values[name] = wide[condition] - wide[against]
        for name, value in values.items():
            tested = rank_sum(value[of == group], value[of == reference])
            quantity = "log of the ratio of lap times, group / reference"
            found.append(replace(tested, name=name, quantity=quantity))
    return found


def group_model(
    frames: StudyFrames, laps: pd.DataFrame, group: str, reference: str, level: float = 0.95
) -> list[TestResult]:
    """Fit log time ~ group * condition + (1 | participant) to two groups' laps.

    Returns
    -------
    list of TestResult
        The group's contrast in the reference condition, on people's degrees of freedom, then one
        interaction per other condition.
    """
    against = reference_condition(frames.parts)
    laps = laps[laps["group"].isin([group, reference])]
    if against is None or against not in set(laps["condition"]):
        return []
    others = [c for c in frames.conditions if c != against and c in set(laps["condition"])]
    mine = indicator(laps["group"], group)
    conditions = [indicator(laps["condition"], c) for c in others]
    matrix = np.column_stack([np.ones(len(laps)), mine, *conditions,
                              *(mine * c for c in conditions)])  # fmt: skip
    fit = fit_random_intercept(laps["log_time"], matrix, laps["participant"])
    if fit is None:
        return []
    n = int(laps["participant"].nunique())
    names = [f"{against}: {group} against {reference}"]
    names += [f"{c} against {against}: {group} against {reference}" for c in others]
    columns = [1, *range(2 + len(others), matrix.shape[1])]
    weights = np.eye(matrix.shape[1])
    return [
        replace(
            model_result(fit, weights[at], n=n, level=level, formula="group * condition"),
            name=name,
            quantity="log of the ratio of lap times, group / reference",
        )
        for name, at in zip(names, columns, strict=True)
    ]
