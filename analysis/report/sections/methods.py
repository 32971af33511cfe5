"""Methods, as text for a paper."""

from analysis.report.blocks import Paragraph, Section
from analysis.report.words import plural
from analysis.results import StudyResults
from analysis.stats.bootstrap import RESAMPLES
from analysis.versions import Recording, analysis_versions, recording_versions


def methods_section(results: StudyResults) -> Section:
    """Return text that can be pasted into a paper."""
    return Section(
        "methods",
        "Methods",
        (
            Paragraph(_design(results)),
            Paragraph(_tests(results)),
            Paragraph(_models(results)),
            Paragraph(_maps_and_model()),
            Paragraph(f"Analysis: {_listed(analysis_versions())}."),
            *(Paragraph(_recorded(r)) for r in recording_versions(results.frames.study)),
        ),
    )


def _design(results: StudyResults) -> str:
    protocol, flow = results.frames.study.protocol, results.flow
    laps = ", ".join(
        f"{lap.condition}{' (practice)' if lap.practice else ''}" for lap in protocol.laps
    )
    seed = results.frames.study.seed
    return (
        f"Within-subject design; protocol {protocol.name!r} on course "
        f"{results.frames.study.course.name!r}"
        f"{'' if seed is None else f', seed {seed}'}. Laps in order: {laps}. Practice laps are not "
        f"analysed. Of {plural(flow.planned, 'planned participant')}, {flow.recorded} were "
        f"recorded and {flow.analysed} analysed."
    )


def _tests(results: StudyResults) -> str:
    families = {c.family for c in results.declared if c.kind == "confirmatory"}
    return (
        "Conditions were compared within participants; where a condition was driven more than "
        "once, a participant's laps were averaged. Wilcoxon signed-rank tests are two-sided and "
        "exact given ties (mid-ranks; zeros after Pratt), a normal approximation above 200 "
        "non-zero pairs; the estimate is the Hodges-Lehmann pseudomedian. Effect sizes are the "
        "matched-pairs rank-biserial correlation and d_z, with BCa bootstrap intervals over "
        f"participants ({RESAMPLES:,} resamples); mean differences have t intervals. Confirmatory "
        f"p-values are corrected after Holm within their family ({len(families)} declared); "
        "exploratory ones are not corrected. Equivalence is tested with two one-sided t-tests "
        "(TOST) within declared margins. Two-sample Kolmogorov-Smirnov tests are exact for small "
        "samples and descriptive, since the samples come from the same people. Speedups are given "
        "as ratio of means (Fieller interval) and as mean of ratios (t interval) over complete "
        "pairs. A pair with a missing value is left out of its comparison and counted. Lap times "
        "exist for finished laps only; other outcomes of the lap table include unfinished laps, "
        "measures from steps do not."
    )


def _models(results: StudyResults) -> str:
    used = list(dict.fromkeys(found.method for found in results.model if found.method))
    return (
        f"Log lap times: {'; '.join(used) or 'no mixed model could be fitted'}. The fit was "
        "checked for convergence and for effects of exactly zero; where either failed, a "
        "permutation test over participants took its place. Items of questionnaires were also "
        "analysed by proportional-odds regression with a percentile bootstrap over participants "
        "(999 resamples); composite scores are given with Cronbach's alpha."
    )


def _maps_and_model() -> str:
    return (
        "Assistance maps: positions of steps in which an assistant's command counted, on a 0.1 m "
        "grid, smoothed with a Gaussian kernel of 0.25 m standard deviation and normalised to "
        "integrate to 1; two maps are compared by their overlap coefficient, tested by exchanging "
        "the two sources within participants. The model's p(h = 1 | x) was recorded before it "
        "learnt from a step and is compared with the demonstrator's signal, or in laps that the "
        "demonstrator did not drive with the signal of a shadow demonstrator that touched nothing."
    )


def _listed(versions: dict[str, str]) -> str:
    return ", ".join(f"{name} {version}" for name, version in versions.items())


def _recorded(by: Recording) -> str:
    if not by.versions:
        return "Recording: package versions not recorded."
    sessions = "" if by.sessions is None else f" ({plural(by.sessions, 'session')})"
    return f"Recording{sessions}: {_listed(by.versions)}."
