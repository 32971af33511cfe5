"""The role of each condition in a study: full control, limited, or helped by which assistant."""

from dataclasses import dataclass
from typing import Literal

from protocols.study import StudyProtocol

Role = Literal["baseline", "limited", "demonstrator", "model"]


@dataclass(frozen=True, slots=True)
class Part:
    """A condition and its role in the study.

    Attributes
    ----------
    condition
        Name of the condition.
    role
        Full control without help; limited without help; helped by a demonstrator or the model.
    demonstrations
        Training laps driven before the condition's first lap; of a borrowed model those that its
        teacher drove.
    training
        Whether the model learns during the condition's laps.
    """

    condition: str
    role: Role
    demonstrations: int
    training: bool = False

    @property
    def taught(self) -> bool:
        """Whether the model has learnt something before or during the condition's laps."""
        return self.training or self.demonstrations > 0


def condition_roles(protocol: StudyProtocol) -> tuple[Part, ...]:
    """Return the analysed conditions with their roles, in the order of their first lap.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> [part.role for part in condition_roles(load_protocol("four-lap"))]
    ['baseline', 'limited', 'demonstrator', 'model']
    """
    parts: dict[str, Part] = {}
    demonstrations = 0
    for lap in protocol.laps:
        condition = protocol.conditions[lap.condition]
        if not lap.practice and lap.condition not in parts:
            alone: Role = "limited" if condition.limitation else "baseline"
            role = alone if condition.assistant == "none" else condition.assistant
            shown = demonstrations if condition.model == "own" else _training_laps(protocol)
            parts[lap.condition] = Part(lap.condition, role, shown, condition.training)
        demonstrations += condition.training
    return tuple(parts.values())


def _training_laps(protocol: StudyProtocol) -> int:
    return sum(protocol.conditions[lap.condition].training for lap in protocol.laps)


def first(parts: tuple[Part, ...], role: Role) -> str | None:
    """Return the first condition with a role; None when there is none."""
    return next((part.condition for part in parts if part.role == role), None)


def reference_condition(parts: tuple[Part, ...]) -> str | None:
    """Return the condition that speedups are measured from: limited, else the baseline."""
    return first(parts, "limited") or first(parts, "baseline")
