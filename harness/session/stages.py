"""A session as a list of stages, in the order in which a participant goes through them."""

from dataclasses import dataclass
from typing import Literal

from protocols.laps import PlannedLap
from protocols.order import laps_of
from protocols.study import StudyProtocol

StageKind = Literal["consent", "demographics", "lap", "questions", "break", "debrief"]


@dataclass(frozen=True, slots=True)
class Stage:
    """One stage of a session.

    Attributes
    ----------
    kind
        What happens.
    lap
        Position of the lap that is driven, or that is asked about or rested from; None where the
        stage belongs to no lap.
    planned
        That lap in the protocol; None as for ``lap``.
    """

    kind: StageKind
    lap: int | None = None
    planned: PlannedLap | None = None


def stages_of(protocol: StudyProtocol, number: int, seed: int) -> tuple[Stage, ...]:
    """Return the stages of one participant's session: those that the protocol asks for.

    Parameters
    ----------
    protocol
        The study.
    number
        The participant, counted from 1.
    seed
        The study's seed, 0 or more.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> stages = stages_of(load_protocol("four-lap"), 1, 0)
    >>> [stage.kind for stage in stages[:4]]
    ['lap', 'lap', 'questions', 'lap']
    """
    stages = []
    if protocol.consent is not None:
        stages.append(Stage("consent"))
    if protocol.demographics:
        stages.append(Stage("demographics"))
    for lap, planned in enumerate(laps_of(protocol, number, seed)):
        stages.append(Stage("lap", lap, planned))
        if planned.survey:
            stages.append(Stage("questions", lap, planned))
        if planned.break_s:
            stages.append(Stage("break", lap, planned))
    if protocol.survey:
        stages.append(Stage("questions"))
    if protocol.debrief is not None:
        stages.append(Stage("debrief"))
    return tuple(stages)
