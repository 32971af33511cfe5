"""The rows of the study's tables, as a session fills them in.

Their fields are the columns of ``protocols.record.tables``, name by name; what each means, its
unit and its allowed values stand there.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

EndReason = Literal["finished", "time_limit", "withdrew"]


def participant_id(number: int) -> str:
    """Return the id of a participant's number, counted from 1.

    Examples
    --------
    >>> participant_id(1)
    'P0001'
    """
    return f"P{number:04d}"


@dataclass(frozen=True, slots=True, kw_only=True)
class ParticipantRow:
    """One participant, after the session."""

    participant: str
    kind: Literal["synthetic", "scripted", "live"]
    driver: str
    impairment: str = "none"
    age_years: int | None = None
    gender: str | None = None
    handedness: str | None = None
    traits: Mapping[str, float]
    consented: bool = True
    completed: bool
    laps_planned: int
    laps_driven: int
    excluded: bool = False
    exclusion_reason: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class LapRow:
    """One lap, finished or not."""

    participant: str
    lap: int
    condition: str
    practice: bool
    limited: bool
    assistant: Literal["none", "demonstrator", "model"]
    training: bool
    completed: bool
    end_reason: EndReason
    withdrawal: str | None = None
    lap_time_s: float | None
    duration_s: float
    steps: int
    collisions: int
    contact_time_s: float
    assisted_fraction: float
    interventions: int
    gates_passed: int
    basis_vectors_when: int | None = None
    basis_vectors_how: int | None = None
    seed: int


@dataclass(frozen=True, slots=True, kw_only=True)
class SurveyRow:
    """One answer; ``response`` is None where the question stayed unanswered."""

    participant: str
    lap: int
    condition: str
    instrument: str
    item: str
    response: int | None
