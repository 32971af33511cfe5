"""Whether the parts of one protocol agree with one another."""

from collections.abc import Iterator, Mapping

from protocols.cohort import Cohort
from protocols.condition import Condition
from protocols.declared import Comparison
from protocols.files.fault import Fault, InconsistentError, Location
from protocols.files.suggestion import allowed
from protocols.laps import AskedInstrument, PlannedLap


def check_consistency(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    analyses: tuple[Comparison, ...],
    *,
    cohort: Cohort,
    taught: bool = False,
    survey: tuple[AskedInstrument, ...] = (),
) -> None:
    """Refuse a protocol whose parts contradict one another.

    Parameters
    ----------
    conditions, laps, analyses
        As the protocol has them.
    cohort
        Whether there is a demonstrator, and a respondent.
    taught
        Whether the model may have been taught before the study.
    survey
        What is asked after the last lap.

    Raises
    ------
    InconsistentError
        With every fault found and its location in the file.
    """
    faults = (
        *_absent_faults(conditions, laps, cohort),
        *_session_survey_faults(survey, cohort),
        *_lap_faults(conditions, laps, taught),
        *_analysis_faults(conditions, laps, analyses),
    )
    if faults:
        raise InconsistentError(faults)


def _absent_faults(
    conditions: Mapping[str, Condition], laps: tuple[PlannedLap, ...], cohort: Cohort
) -> Iterator[Fault]:
    """Find what needs a demonstrator or a respondent in a study without one."""
    for name, condition in conditions.items():
        if cohort.demonstrator is None and condition.assistant == "demonstrator":
            message = "needs a demonstrator; allowed: another assistant, or cohort.demonstrator"
            yield Fault(("conditions", name, "assistant"), message)
    for i, lap in enumerate(laps):
        if cohort.respondent is None and lap.survey:
            message = "nobody answers; allowed: no survey, or cohort.respondent"
            yield Fault(("laps", i, "survey"), message)


def _unknown_condition(given: str, conditions: Mapping[str, Condition]) -> str:
    return f"'{given}' is not a condition of this protocol; {allowed(given, conditions)}"


def _lap_faults(
    conditions: Mapping[str, Condition], laps: tuple[PlannedLap, ...], taught: bool
) -> Iterator[Fault]:
    trained = taught
    for i, lap in enumerate(laps):
        condition = conditions.get(lap.condition)
        if condition is None:
            message = _unknown_condition(lap.condition, conditions)
            yield Fault(("laps", i, "condition"), message)
            trained = True  # an unknown lap may have been the training: no second-hand fault
            continue
        if condition.assistant == "model" and not trained:
            message = (
                f"'{lap.condition}' is assisted by the model, which has learnt nothing yet; "
                "put a lap with training: true before it"
            )
            yield Fault(("laps", i, "condition"), message)
        trained = trained or condition.training
        yield from _repeated_instruments(("laps", i), lap.survey)
    if all(lap.practice for lap in laps):
        yield Fault(("laps",), "every lap is practice; at least one must not be")


def _session_survey_faults(surveys: tuple[AskedInstrument, ...], cohort: Cohort) -> Iterator[Fault]:
    if cohort.respondent is None and surveys:
        yield Fault(("survey",), "nobody answers; allowed: no survey, or cohort.respondent")
    yield from _repeated_instruments((), surveys)


def _repeated_instruments(at: Location, surveys: tuple[AskedInstrument, ...]) -> Iterator[Fault]:
    asked: set[str] = set()
    for j, survey in enumerate(surveys):
        where: Location = (*at, "survey", j)
        if survey.instrument in asked:
            message = f"'{survey.instrument}' is asked twice at one time; once is allowed"
            yield Fault((*where, "instrument"), message)
        asked.add(survey.instrument)
        items = survey.items if isinstance(survey.items, tuple) else ()
        for k, item in enumerate(items):
            if item in items[:k]:
                yield Fault((*where, "items", k), f"'{item}' is asked twice; once is allowed")


def _analysis_faults(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    analyses: tuple[Comparison, ...],
) -> Iterator[Fault]:
    driven = {lap.condition: None for lap in laps if not lap.practice}
    misspelt = any(lap.condition not in conditions for lap in laps)
    names: set[str] = set()
    for i, comparison in enumerate(analyses):
        if comparison.name in names:
            message = f"'{comparison.name}' is the name of an earlier analysis; names are unique"
            yield Fault(("analyses", i, "name"), message)
        names.add(comparison.name)
        for role in ("condition", "reference"):
            given = getattr(comparison, role)
            if given not in conditions:
                yield Fault(("analyses", i, role), _unknown_condition(given, conditions))
            elif given not in driven and not misspelt:
                message = f"no lap to analyse has the condition '{given}'; {allowed(given, driven)}"
                yield Fault(("analyses", i, role), message)
        if comparison.item is not None and comparison.equivalence_margin is not None:
            message = (
                f"equivalence is tested on means, which answers ({comparison.outcome}) do not "
                "have; allowed: no margin, or an outcome of a lap"
            )
            yield Fault(("analyses", i, "equivalence_margin"), message)
        if comparison.condition == comparison.reference:
            message = f"'{comparison.reference}' would be compared with itself"
            yield Fault(("analyses", i, "reference"), message)
