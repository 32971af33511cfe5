"""Whether the parts of one protocol agree with one another."""

from collections.abc import Iterator, Mapping

from protocols.cohort import Cohort, DemonstratorChoice
from protocols.condition import Condition
from protocols.declared import Comparison
from protocols.files.fault import Fault, InconsistentError, Location
from protocols.files.suggestion import allowed
from protocols.groups import Group
from protocols.laps import AskedInstrument, PlannedLap
from protocols.model_choice import BorrowedModel
from protocols.model_consistency import model_faults, taught_before
from protocols.orders import Orders, legal_orders, order_faults, put_in_order, untaught
from protocols.shipped_parts import LAD, LIVE


def check_consistency(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    analyses: tuple[Comparison, ...],
    *,
    cohort: Cohort,
    model: str = LAD,
    survey: tuple[AskedInstrument, ...] = (),
    orders: Orders | None = None,
    groups: Mapping[str, Group] | None = None,
    models: Mapping[str, BorrowedModel] | None = None,
    demonstrators: Mapping[str, DemonstratorChoice] | None = None,
) -> None:
    """Refuse a protocol whose parts contradict one another.

    Parameters
    ----------
    conditions, laps, analyses
        As the protocol has them.
    cohort
        Whether there is a demonstrator, and a respondent.
    model
        The participant's own, by name.
    survey
        What is asked after the last lap.
    orders, groups, models, demonstrators
        As the protocol has them; None for a fixed order, no groups, no borrowed models and no
        further demonstrators.

    Raises
    ------
    InconsistentError
        With every fault found and its location in the file.
    """
    taught = taught_before(model)
    faults = (
        *_absent_faults(conditions, laps, cohort),
        *_session_survey_faults(survey, cohort),
        *_lap_faults(conditions, laps, taught, orders or Orders()),
        *model_faults(conditions, laps, groups or {}, models or {}, model),
        *_demonstrator_faults(conditions, demonstrators or {}, ("conditions",)),
        *_further_faults(demonstrators or {}, cohort),
        *_group_faults(conditions, groups or {}, demonstrators or {}, cohort),
        *_untaught_faults(conditions, laps, groups or {}, taught, orders or Orders()),
        *_analysis_faults(conditions, laps, analyses),
        *_between_faults(analyses, groups or {}),
    )
    if faults:
        raise InconsistentError(faults)


def _absent_faults(
    conditions: Mapping[str, Condition], laps: tuple[PlannedLap, ...], cohort: Cohort
) -> Iterator[Fault]:
    """Find what needs a demonstrator or a respondent in a study without one."""
    for name, condition in conditions.items():
        if cohort.demonstrator is None and (where := _needs_a_demonstrator(condition)):
            message = "needs a demonstrator; allowed: another assistant, or cohort.demonstrator"
            yield Fault(("conditions", name, where), message)
    for i, lap in enumerate(laps):
        if cohort.respondent is None and lap.survey:
            message = "there is no respondent; allowed: no survey, or cohort.respondent"
            yield Fault(("laps", i, "survey"), message)


def _needs_a_demonstrator(condition: Condition) -> str | None:
    """Return the field of a condition that cannot do without a demonstrator; None for none."""
    if condition.assistant == "demonstrator":
        return "assistant"
    return None if condition.corrections is None else "corrections"


def _demonstrator_faults(
    conditions: Mapping[str, Condition],
    demonstrators: Mapping[str, DemonstratorChoice],
    at: Location,
) -> Iterator[Fault]:
    known = ["own", *demonstrators]
    for name, condition in conditions.items():
        if condition.demonstrator not in known:
            message = f"'{condition.demonstrator}' is no demonstrator of this protocol; "
            message += allowed(condition.demonstrator, known)
            yield Fault((*at, name, "demonstrator"), message)


def _further_faults(
    demonstrators: Mapping[str, DemonstratorChoice], cohort: Cohort
) -> Iterator[Fault]:
    for name, choice in demonstrators.items():
        at: Location = ("demonstrators", name)
        if name == "own":
            yield Fault(at, "own is the cohort's demonstrator; allowed: another name")
        if cohort.demonstrator is None:
            yield Fault(at, "is one further; allowed: only with a cohort.demonstrator")
        if choice.use == LIVE:
            message = "there is one seat for a living demonstrator; allowed: cohort.demonstrator"
            yield Fault((*at, "use"), message)


def _unknown_condition(given: str, conditions: Mapping[str, Condition]) -> str:
    return f"'{given}' is not a condition of this protocol; {allowed(given, conditions)}"


def _lap_faults(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    taught: bool,
    orders: Orders,
) -> Iterator[Fault]:
    trained = taught or orders.use != "fixed"  # of other orders only those are driven that teach
    for i, lap in enumerate(laps):
        condition = conditions.get(lap.condition)
        if condition is None:
            message = _unknown_condition(lap.condition, conditions)
            yield Fault(("laps", i, "condition"), message)
            trained = True  # an unknown lap may have been the training: report only the first fault
            continue
        if condition.assistant == "model" and condition.model == "own" and not trained:
            message = (
                f"'{lap.condition}' is assisted by the model, which has learnt nothing yet; "
                "put a lap with training: true before it"
            )
            yield Fault(("laps", i, "condition"), message)
        trained = trained or condition.training
        yield from _repeated_instruments(("laps", i), lap.survey)
    if all(lap.practice for lap in laps):
        yield Fault(("laps",), "every lap is practice; at least one must not be")
    yield from _order_faults(conditions, laps, taught, orders)


def _order_faults(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    taught: bool,
    orders: Orders,
) -> Iterator[Fault]:
    """Find orders that cannot be driven, once conditions and laps are right."""
    faults = tuple(order_faults(orders, laps))
    yield from faults
    if faults or any(lap.condition not in conditions for lap in laps) or orders.use == "fixed":
        return
    if orders.use == "list":
        for i, order in enumerate(orders.orders):
            missing = untaught(put_in_order(laps, order), conditions, taught=taught)
            if missing is not None:
                message = f"'{missing}' comes before the model has learnt anything in this order"
                yield Fault(("orders", "list", i), message)
    if not legal_orders(orders, laps, conditions, taught=taught):
        message = (
            f"no order of {orders.use} can be driven: in each a model helps before it was taught, "
            "or a rule is broken; allowed: other orders, fewer rules, or a borrowed model"
        )
        yield Fault(("orders", "use"), message)


def _group_faults(
    conditions: Mapping[str, Condition],
    groups: Mapping[str, Group],
    demonstrators: Mapping[str, DemonstratorChoice],
    cohort: Cohort,
) -> Iterator[Fault]:
    if len(groups) == 1:
        yield Fault(("groups",), "1 group is no factor; allowed: none, or 2 or more")
    for name, group in groups.items():
        at: Location = ("groups", name, "conditions")
        for condition in group.conditions:
            if condition not in conditions:
                yield Fault((*at, condition), _unknown_condition(condition, conditions))
        yield from _demonstrator_faults(group.conditions, demonstrators, at)
        absent = cohort.demonstrator is None and group.demonstrator is None
        for condition, settings in group.conditions.items():
            if absent and (where := _needs_a_demonstrator(settings)):
                message = "needs a demonstrator; allowed: another assistant, or a demonstrator"
                yield Fault((*at, condition, where), message)


def _untaught_faults(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    groups: Mapping[str, Group],
    taught: bool,
    orders: Orders,
) -> Iterator[Fault]:
    """Find groups whose own conditions leave a model untaught in an order that they drive."""
    if any(lap.condition not in conditions for lap in laps) or tuple(order_faults(orders, laps)):
        return
    for name, group in groups.items():
        own = {**conditions, **group.conditions}
        before = taught_before(group.model.use) if group.model is not None else taught
        for order in legal_orders(orders, laps, conditions, taught=taught):
            missing = untaught(put_in_order(laps, order), own, taught=before)
            if missing is not None:
                message = (
                    f"'{missing}' is assisted by the model, which has learnt nothing yet in this "
                    f"group's laps ({' > '.join(order)}); allowed: a lap with training: true "
                    "before it, or a borrowed model"
                )
                yield Fault(("groups", name), message)
                break


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
        for role, given in zip(("condition", "reference"), comparison.conditions, strict=False):
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


def _between_faults(
    analyses: tuple[Comparison, ...], groups: Mapping[str, Group]
) -> Iterator[Fault]:
    """Find comparisons of groups that cannot be made, and comparisons with nothing to compare."""
    for i, comparison in enumerate(analyses):
        at: Location = ("analyses", i)
        if comparison.groups is None:
            if comparison.reference is None:
                message = "is missing; allowed: a condition to compare with, or groups to compare"
                yield Fault((*at, "reference"), message)
            continue
        for j, name in enumerate(comparison.groups):
            if name not in groups:
                message = f"'{name}' is not a group of this protocol; {allowed(name, groups)}"
                yield Fault((*at, "groups", j), message)
        if comparison.groups[0] == comparison.groups[1]:
            message = f"'{comparison.groups[0]}' would be compared with itself"
            yield Fault((*at, "groups", 1), message)
        if comparison.equivalence_margin is not None:
            message = "equivalence is tested within participants; allowed: no margin, or no groups"
            yield Fault((*at, "equivalence_margin"), message)
