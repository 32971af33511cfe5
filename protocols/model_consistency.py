"""Whether a protocol's conditions and the models that they name agree."""

from collections.abc import Iterator, Mapping

from protocols.condition import Condition
from protocols.files.fault import Fault, Location
from protocols.files.suggestion import allowed
from protocols.groups import Group
from protocols.laps import PlannedLap
from protocols.model_choice import BorrowedModel
from protocols.shipped_parts import LEVEL, MODELS, WITH_PARAMETERS


def taught_before(model: str) -> bool:
    """Return whether a model may know something before the study; of a foreign one it may.

    Examples
    --------
    >>> taught_before("lad"), taught_before("taught")
    (False, True)
    """
    return model not in WITH_PARAMETERS


def model_faults(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    groups: Mapping[str, Group],
    models: Mapping[str, BorrowedModel],
    model: str,
) -> Iterator[Fault]:
    """Yield models that are not there, cannot be taught, or learn no level of assistance.

    Parameters
    ----------
    conditions, laps, groups, models
        As the protocol has them.
    model
        The participant's own, by name.
    """
    if "own" in models:
        yield Fault(("models", "own"), "own is the participant's model; allowed: another name")
    yield from _pilot_faults(conditions, laps, models)
    yield from _faults(conditions, models, model, ("conditions",))
    for name, group in groups.items():
        own = model if group.model is None else group.model.use
        yield from _faults(group.conditions, models, own, ("groups", name, "conditions"))
        if group.model is not None:
            kept = {n: c for n, c in conditions.items() if n not in group.conditions}
            yield from _level_faults(kept, models, own, ("conditions",))


def _faults(
    conditions: Mapping[str, Condition],
    models: Mapping[str, BorrowedModel],
    model: str,
    at: Location,
) -> Iterator[Fault]:
    known = ["own", *models]
    for name, condition in conditions.items():
        if condition.model not in known:
            message = f"'{condition.model}' is no model of this protocol; "
            yield Fault((*at, name, "model"), message + allowed(condition.model, known))
    yield from _level_faults(conditions, models, model, at)


def _level_faults(
    conditions: Mapping[str, Condition],
    models: Mapping[str, BorrowedModel],
    model: str,
    at: Location,
) -> Iterator[Fault]:
    """Find conditions that need a level of assistance where the model learns none.

    A model from a file is known when it is read; every other borrowed one is of the own kind.
    """
    if model not in MODELS or model in (LEVEL, "taught"):
        return
    for name, condition in conditions.items():
        borrowed = models.get(condition.model)
        of_own_kind = borrowed is None or borrowed.source != "file"
        if condition.arbitration == "blend-learnt" and of_own_kind:
            message = f"{model} learns no level of assistance; allowed: model: {{use: {LEVEL}}}"
            yield Fault((*at, name, "arbitration"), message)


def _pilot_faults(
    conditions: Mapping[str, Condition],
    laps: tuple[PlannedLap, ...],
    models: Mapping[str, BorrowedModel],
) -> Iterator[Fault]:
    """Find models that are to be taught by a lap that the protocol does not have."""
    driven = [conditions[lap.condition] for lap in laps if lap.condition in conditions]
    for name, model in models.items():
        if model.source in ("pilot", "previous participant") and not any(
            condition.training for condition in driven
        ):
            message = f"{model.source} needs a lap with training: true to learn from"
            yield Fault(("models", name, "from"), message)
