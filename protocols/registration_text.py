"""The text of a registration, under the headings of the common registries."""

from collections.abc import Iterator

from protocols.balance import balance_in_words, groups_in_words
from protocols.declared import Comparison
from protocols.resolved import ResolvedStudy
from protocols.study import StudyProtocol

Part = tuple[str, str | None]
"""A heading, and its text; None where only a person can write it."""

_PENDING = "**To be written.**"


def registration_text(study: ResolvedStudy, digest: str) -> tuple[str, tuple[str, ...]]:
    """Return the document in Markdown, and the headings that are still to be written.

    Parameters
    ----------
    study
        What is registered.
    digest
        Of the plan.
    """
    parts = (("OSF Preregistration", tuple(_osf(study))), ("AsPredicted", tuple(_predicted(study))))
    gaps = tuple(f"{name}: {heading}" for name, ps in parts for heading, text in ps if text is None)
    lines = [f"# {study.protocol.title}", "", f"Plan: SHA-256 {digest} (plan.json)", ""]
    if gaps:
        lines += ["To be written by hand:", "", *(f"- {gap}" for gap in gaps), ""]
    for name, filled in parts:
        lines += [f"## {name}", ""]
        for heading, text in filled:
            lines += [f"### {heading}", "", text or _PENDING, ""]
    return "\n".join(lines), gaps


def _osf(study: ResolvedStudy) -> Iterator[Part]:
    protocol = study.protocol
    yield "Title", protocol.title
    yield "Description", protocol.description or None
    yield "Hypotheses", _hypotheses(protocol)
    yield "Study type", "Experiment."
    yield "Blinding", None
    yield "Study design", _design(study)
    yield "Randomization", _randomization(protocol)
    yield "Existing data", "Registration prior to creation of data."
    yield "Data collection procedures", None
    yield "Sample size", _sample(protocol)
    yield "Sample size rationale", None
    yield "Stopping rule", f"Data collection ends with {protocol.cohort.participants} participants."
    yield "Manipulated variables", _conditions(protocol)
    yield "Measured variables", _measured(study)
    yield "Indices", _indices(study)
    yield "Statistical models", _analyses(protocol)
    yield "Transformations", "Lap times are compared as log ratios."
    yield "Inference criteria", _criteria(protocol)
    yield "Margins of equivalence, and why", _margins(protocol)
    yield "Data exclusion", _exclusion(protocol)
    yield "Missing data", _missing(protocol)
    yield "Exploratory analysis", "Everything in the report that is not confirmatory above."


def _predicted(study: ResolvedStudy) -> Iterator[Part]:
    protocol = study.protocol
    yield "1. Have any data been collected for this study already?", "No."
    yield (
        "2. What is the main question being asked or hypothesis being tested?",
        _hypotheses(protocol),
    )
    yield "3. Dependent variables and how they are measured", _measured(study)
    yield (
        "4. How many and which conditions will participants be assigned to?",
        (f"{_conditions(protocol)} {_randomization(protocol)}"),
    )
    yield "5. Which analyses will be conducted?", _analyses(protocol)
    yield (
        "6. How will outliers be defined and handled; which observations are excluded?",
        (_exclusion(protocol)),
    )
    yield "7. How many observations, and what determines the sample size?", _sample(protocol)
    yield "8. Anything else?", _missing(protocol)


def _hypotheses(protocol: StudyProtocol) -> str | None:
    confirmatory = [a for a in protocol.analyses if a.kind == "confirmatory"]
    return " ".join(f"{a.name[0].upper()}{a.name[1:]}." for a in confirmatory) or None


def _design(study: ResolvedStudy) -> str:
    protocol = study.protocol
    laps = ", ".join(
        f"{lap.condition}{' (practice)' if lap.practice else ''}" for lap in protocol.laps
    )
    between = (
        f" Between participants: groups {', '.join(protocol.groups)}." if protocol.groups else ""
    )
    return f"Within participants, on course {study.course.name}. Laps: {laps}.{between}"


def _randomization(protocol: StudyProtocol) -> str:
    said = [f"{sentence[0].upper()}{sentence[1:]}." for sentence in balance_in_words(protocol)]
    if not said and not protocol.groups:
        return "None: every participant drives the laps in the order above."
    if (groups := groups_in_words(protocol)) is not None:
        said.append(f"Groups: {groups}.")
    said.append("Orders and groups are drawn in permuted blocks from the digest of this plan.")
    return " ".join(said)


def _sample(protocol: StudyProtocol) -> str:
    cohort = protocol.cohort
    dropout = (
        f"; {100 * cohort.expected_dropout:g}% are expected to drop out"
        if cohort.expected_dropout
        else ""
    )
    return f"{cohort.participants} participants{dropout}."


def _conditions(protocol: StudyProtocol) -> str:
    analysed = dict.fromkeys(lap.condition for lap in protocol.laps if not lap.practice)
    return f"{len(analysed)} conditions: {', '.join(analysed)} (settings: protocol.yaml)."


def _measured(study: ResolvedStudy) -> str:
    outcomes = dict.fromkeys(a.outcome for a in study.protocol.analyses)
    asked = ", ".join(i.title for i in study.instruments)
    return f"Declared outcomes: {', '.join(outcomes) or 'none'}. Questionnaires: {asked or 'none'}."


def _indices(study: ResolvedStudy) -> str:
    said = [
        f"{i.title}: mean of each subscale's items, reverse-coded items turned"
        + ("." if i.score is None else f", on a scale of {i.score[0]:g} to {i.score[1]:g}.")
        for i in study.instruments
    ]
    return " ".join(said) or "None."


def _analyses(protocol: StudyProtocol) -> str | None:
    return "\n".join(f"- {_analysis(a)}" for a in protocol.analyses) or None


def _analysis(a: Comparison) -> str:
    family = f", family '{a.family}'" if a.kind == "confirmatory" else ""
    test = "Wilcoxon signed-rank, two-sided"
    if a.outcome == "lap_time_s":
        test += ", of log ratios, less each place's mean where place is balanced"
    if a.equivalence_margin is not None:
        test = f"two one-sided t-tests within ±{a.equivalence_margin:g}"
    compared = " against ".join(a.conditions)
    if a.groups is not None:
        first, second = a.groups
        compared = f"{compared}, group {first} against group {second}"
        test = "Wilcoxon rank-sum of people's values, two-sided, exact up to 100 people"
        if a.outcome == "lap_time_s":
            test += ", of logs" if a.reference is None else ", of log ratios (group x condition)"
    return f"{a.name} ({a.kind}{family}): {a.outcome}, {compared}; {test}."


def _criteria(protocol: StudyProtocol) -> str:
    families = dict.fromkeys(a.family for a in protocol.analyses if a.kind == "confirmatory")
    holm = f", after Holm within each family ({', '.join(families)})" if families else ""
    return f"p below .05, two-sided{holm}; exploratory tests are not corrected."


def _margins(protocol: StudyProtocol) -> str | None:
    margins = [a for a in protocol.analyses if a.equivalence_margin is not None]
    if not margins:
        return "No equivalence is tested."
    if any(not a.margin_reason for a in margins):
        return None
    return " ".join(f"{a.name}: ±{a.equivalence_margin:g}, {a.margin_reason}." for a in margins)


def _exclusion(protocol: StudyProtocol) -> str:
    rules = protocol.exclusion
    words = {
        "min_completed_laps": "fewer than {:g} completed laps",
        "max_collisions": "more than {:g} collisions",
        "max_late_share": "a larger share than {:g} of steps that started late",
        "max_input_age_s": "commands older than {:g} s (99th percentile)",
        "max_interruptions": "more than {:g} laps paused, stopped or disconnected",
    }
    limits = {name: getattr(rules, name) for name in words}
    said = [words[name].format(limit) for name, limit in limits.items() if limit is not None]
    if not said:
        return "No participant is excluded by a rule."
    return f"Participants with {' or '.join(said)} (practice apart) are excluded."


def _missing(protocol: StudyProtocol) -> str:
    ways = {a.unfinished for a in protocol.analyses if a.outcome == "lap_time_s"}
    words = {
        "complete pairs": "a pair without both lap times is left out",
        "limit": "an unfinished lap counts as a lap that took its time limit",
        "worst rank": "an unfinished lap counts as slower than every finished one",
    }
    said = "; ".join(words[way] for way in sorted(ways))
    start = f"Unfinished laps: {said}. " if said else ""
    return f"{start}The report shows the other ways beside it. Missing answers stay missing."
