"""Methods, as text for a paper: only what this study did."""

import math
from collections.abc import Iterable, Iterator

from analysis.comparisons import PairedComparison
from analysis.frames import StudyFrames
from analysis.maps import BANDWIDTH, CELL
from analysis.order import driven_orders
from analysis.outcomes import UNITS
from analysis.report.blocks import Paragraph, Section
from analysis.report.numbers import plural
from analysis.results import StudyResults, SurveyResults
from analysis.roles import reference_condition
from analysis.stats.result import TestResult
from analysis.versions import Recording, analysis_versions, recording_versions
from protocols.declared import Comparison


def methods_section(results: StudyResults) -> Section:
    """Return text that can be pasted into a paper; each sentence tells what was done."""
    parts = (
        _design,
        _declared,
        _comparisons,
        _between,
        _models,
        _questionnaires,
        _maps,
        _model_quality,
    )
    texts = [" ".join(part(results)) for part in parts]
    texts.append(f"Analysis: {_listed(analysis_versions())}.")
    texts += [_recorded(r) for r in recording_versions(results.frames.study)]
    return Section("methods", "Methods", tuple(Paragraph(text) for text in texts if text))


def _design(results: StudyResults) -> Iterator[str]:
    study, flow = results.frames.study, results.flow
    protocol = study.protocol
    seed = "" if study.seed is None else f", seed {study.seed}"
    course = study.course.name
    groups = protocol.groups
    between = f", {len(groups)} groups of participants ({', '.join(groups)})" if groups else ""
    yield f"Within-subject design{between}; protocol {protocol.name!r} on course {course!r}{seed}."
    yield from (
        f"Group {name!r} drove course {other.name!r}."
        for name, other in study.header.group_courses.items()
    )
    yield from _orders(results.frames)
    if results.frames.practised:
        yield "Practice laps were not analysed."
    planned = "" if flow.planned is None else f"{flow.planned} planned, "
    yield f"Participants: {planned}{flow.recorded} recorded, {flow.analysed} analysed."
    if flow.refused:
        yield f"Without consent, and not analysed: {flow.refused}."
    if flow.consent_unknown:
        yield f"Consent was not recorded of {flow.consent_unknown}, who are analysed."
    yield from _exclusion(results)
    if flow.laps[["time_limit", "withdrew", "unfinished_otherwise"]].to_numpy().any():
        yield (
            "Only finished laps have a lap time and measures of a whole lap; other outcomes of the "
            "lap table, maps, shares by section and the model's calibration include the steps of "
            "unfinished laps."
        )


def _orders(frames: StudyFrames) -> Iterator[str]:
    """Say in which order laps were driven: as recorded, which need not be as planned."""
    orders = driven_orders(frames)
    if not orders:
        return
    (laps, people), *others = orders.most_common()
    if not others:
        yield f"Laps as driven: {', '.join(laps)}."
        return
    drove = "drove" if people > 1 else "participant drove"
    yield (
        f"Laps were driven in {len(orders)} orders; {people} of {orders.total()} {drove}: "
        f"{', '.join(laps)}."
    )


def _exclusion(results: StudyResults) -> Iterator[str]:
    rules, excluded = results.frames.study.protocol.exclusion, results.flow.excluded
    said = []
    if rules.min_completed_laps is not None:
        said.append(f"completed fewer than {plural(rules.min_completed_laps, 'lap')}")
    if rules.max_collisions is not None:
        said.append(f"collided more than {plural(rules.max_collisions, 'time')}")
    if said:
        yield (
            "The protocol excludes from every analysis participants who "
            f"{' or '.join(said)} (practice apart)."
        )
    reasons = "; ".join(f"{reason}: {n}" for reason, n in excluded.items())
    if excluded:
        yield f"Excluded: {reasons}."
    elif results.frames.exclusions.looked:
        yield "Nobody was excluded."
    yield from (f"{remark}." for remark in results.frames.exclusions.remarks)


def _declared(results: StudyResults) -> Iterator[str]:
    declared = results.frames.study.protocol.analyses
    if not declared:
        yield "The protocol declared no comparison; all tests are exploratory."
        return
    yield f"Declared by the protocol: {'; '.join(map(_declaration, declared))}."
    families = {c.family for c in results.declared if math.isfinite(c.p_holm)}
    families |= {c.family for c in results.between if math.isfinite(c.p_holm)}
    if families:
        yield (
            "Confirmatory p-values were corrected after Holm within their family "
            f"({plural(len(families), 'family', 'families')}); all others are not corrected."
        )


def _declaration(c: Comparison) -> str:
    kind = f"confirmatory, family {c.family!r}" if c.kind == "confirmatory" else "exploratory"
    margin = ""
    if c.equivalence_margin is not None:
        within = f"±{c.equivalence_margin:g} {UNITS.get(c.outcome, '')}"
        margin = f", equivalence within {within.rstrip()}"
    groups = "" if c.groups is None else f", {c.groups[0]} − {c.groups[1]}"
    return f"{c.name} ({c.outcome}, {' − '.join(c.conditions)}{groups}; {kind}{margin})"


def _comparisons(results: StudyResults) -> Iterator[str]:
    pairs = _pairs(results)
    tests = _used(c.signed_rank for c in pairs)
    if not tests:
        yield "No test between two conditions could be computed."
        return
    yield (
        f"Conditions were compared within participants: {tests}; the estimate is the "
        "Hodges-Lehmann pseudomedian."
    )
    if times := _used(c.lap_time.test for c in pairs if c.lap_time is not None):
        yield f"Lap times were tested as log ratios, condition / reference: {times}."
    yield from _unfinished(results)
    laps = results.frames.laps
    if laps.duplicated(["participant", "condition"]).any():
        yield (
            "Where a condition was driven more than once, a participant's laps were averaged; of "
            "answers the last one counts, and distributions are those of all laps."
        )
    if any(c.incomplete for c in pairs):
        yield "A pair with a missing value was left out of its comparison and counted."
    if effects := _used(r for c in pairs for r in (c.rank_biserial, c.dz)):
        yield f"Effect sizes: {effects}."
    if any(c.difference is not None and math.isfinite(c.difference.low) for c in pairs):
        yield "Mean differences have paired t intervals."
    if _used(c.equivalence for c in pairs):
        yield (
            "Equivalence of means was tested by two one-sided paired t-tests (TOST), with 90% "
            "intervals, within the margins declared."
        )
    if ratios := _used(r for c in pairs for r in (c.ratio_of_means, c.mean_of_ratios)):
        yield f"Speedups: {ratios}."
    if distributions := _used(c.ks for c in pairs):
        yield (
            f"Distributions: {distributions}; descriptive, since the samples come from "
            "the same people."
        )


def _between(results: StudyResults) -> Iterator[str]:
    if used := _used(c.test for c in results.between):
        yield (
            f"Groups were compared by people's values, each person once: {used}. Of lap times the "
            "values are logs, or log ratios of condition and reference (group x condition)."
        )


def _unfinished(results: StudyResults) -> Iterator[str]:
    """Say what unfinished laps counted as, where there were any."""
    counted = {c.lap_time.unfinished for c in results.declared if c.lap_time and c.sensitivity}
    words = {
        "complete pairs": "left its pair out of the comparison",
        "limit": "counted as a lap that took its time limit",
        "worst rank": "counted as slower than every finished lap",
    }
    for unfinished in sorted(counted):
        yield f"As declared, a lap that was not finished {words[unfinished]}."


def _models(results: StudyResults) -> Iterator[str]:
    if not (used := _used(results.model)):
        return
    reference = reference_condition(results.frames.parts)
    yield f"Log lap times, every condition against {reference}: {used}."
    if any(found.checks for found in results.model):
        yield (
            "Restricted maximum likelihood; standard errors and degrees of freedom after Kenward "
            "and Roger."
        )
    else:
        yield "It replaced a mixed model that could not be fitted."
    if _used(results.contrasts):
        yield (
            "The same contrasts were computed from each participant's own laps, each with its own "
            "standard deviation (paired t on log lap times)."
        )
    if not results.practice.empty:
        yield (
            "Since practice and condition are confounded, a sensitivity table shows what is left "
            "of each contrast if practice saved a given share of the time per lap."
        )


def _questionnaires(results: StudyResults) -> Iterator[str]:
    for survey in results.surveys:
        instrument = survey.instrument
        if not survey.table["answered"].any():
            continue
        points = f" on {instrument.points} points" if instrument.points else ""
        yield f"{instrument.title}: {plural(len(instrument.items), 'item')}{points}."
        if _used(c.signed_rank for c in survey.comparisons):
            odds = _used(c.odds for c in survey.comparisons)
            yield (
                "Items were compared as above, p corrected after Holm over all comparisons of the "
                "instrument's items" + (f", and by {odds}." if odds else ".")
            )
        yield from _scores(survey)
    if results.frames.synthetic and any(s.table["answered"].any() for s in results.surveys):
        yield "Answers of synthetic participants were drawn from a model with assumed loadings."


def _scores(survey: SurveyResults) -> Iterator[str]:
    if survey.scales["n"].any():
        text = "Composite scores are means of a subscale's items over complete answer sheets"
        with_alpha = survey.scales["alpha"].notna().any()
        yield f"{text}, with Cronbach's alpha (Feldt interval)." if with_alpha else f"{text}."


def _maps(results: StudyResults) -> Iterator[str]:
    steps = results.records.steps
    helpers = [p.condition for p in results.frames.parts if p.role in ("demonstrator", "model")]
    placed = steps[["x_m", "y_m", "helped"]].notna().all(axis=1)
    if (placed & steps["condition"].isin(helpers)).any():
        yield (
            "Assistance maps: positions of steps in which an assistant's command counted, on a "
            f"{CELL:g} m grid, smoothed with a Gaussian kernel of {BANDWIDTH:g} m standard "
            "deviation and normalised to integrate to 1."
        )
    if used := _used([results.overlap]):
        yield f"Two maps were compared by their overlap coefficient: {used}."


def _model_quality(results: StudyResults) -> Iterator[str]:
    taught = {part.condition for part in results.frames.parts if part.taught}
    if results.reliability["condition"].isin(taught).any():
        yield (
            "The model's p(h = 1 | x) was recorded before it learnt from a step and is compared "
            "with the demonstrator's signal, or in laps that the demonstrator did not drive with "
            "the signal of a shadow demonstrator that touched nothing."
        )


def _pairs(results: StudyResults) -> tuple[PairedComparison, ...]:
    items = (c for survey in results.surveys for c in survey.comparisons)
    return (*results.declared, *results.lap_times, *items)


def _used(found: Iterable[TestResult | None]) -> str:
    """Return the methods of what could be computed, each once; nothing where nothing could.

    A method that is the beginning of another one is that one without its interval: not repeated.
    """
    methods = dict.fromkeys(f.method for f in found if f is not None and f.computed and f.method)
    whole = [m for m in methods if not any(o != m and o.startswith(m) for o in methods)]
    return "; ".join(method.replace("; ", ", ") for method in whole)


def _listed(versions: dict[str, str]) -> str:
    return ", ".join(f"{name} {version}" for name, version in versions.items())


def _recorded(by: Recording) -> str:
    if not by.versions:
        return "Recording: package versions not recorded."
    sessions = "" if by.sessions is None else f" ({plural(by.sessions, 'session')})"
    return f"Recording{sessions}: {_listed(by.versions)}."
