"""The rows of the study's tables, as a session fills them in.

Their fields are the columns of ``protocols.record.tables``, name by name; what each means, its
unit and its allowed values are there.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

from protocols.condition import AssistantRole
from protocols.instrument import Item

EndReason = Literal[
    "finished", "time_limit", "withdrew", "comfortable", "stopped", "disconnected", "interrupted"
]
"""Finished; too slow; the participant left; a participant ended a practice lap; the experimenter
stopped the lap; a person's connection was lost; the program ended in the middle."""

ASSISTANT_ROLES: tuple[AssistantRole, ...] = get_args(AssistantRole)

END_REASONS: tuple[EndReason, ...] = get_args(EndReason)

ENDS_SESSION: frozenset[EndReason] = frozenset({"withdrew", "interrupted"})
"""A lap with one of these ends is the last of its session."""


def questions_follow(reason: str) -> bool:
    """Tell whether questions about a lap are asked: it was driven to its end or its time limit."""
    return reason in {"finished", "time_limit", "comfortable"}


def participant_id(number: int) -> str:
    """Return the id of a participant's number, counted from 1.

    Examples
    --------
    >>> participant_id(1)
    'P0001'
    """
    return f"P{number:04d}"


def participant_number(participant: str) -> int:
    """Return the number in an id that ``participant_id`` has made; 0 for any other text.

    Examples
    --------
    >>> participant_number("P0012"), participant_number("patient 12")
    (12, 0)
    """
    digits = participant.removeprefix("P")
    return int(digits) if digits.isdecimal() and participant_id(int(digits)) == participant else 0


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
    order: str | None = None
    group: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class LapRow:
    """One lap, finished or not."""

    participant: str
    lap: int
    condition: str
    practice: bool
    limited: bool
    assistant: AssistantRole
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
    stop_reason: str | None = None
    pauses: int | None = None
    paused_s: float | None = None
    late_share: float | None = None
    input_age_p99_s: float | None = None
    last_segments: tuple[float, ...] | None = None
    place: int | None = None
    tuned_steps: int | None = None
    tuned_signal_variance_when: float | None = None
    tuned_signal_variance_how: float | None = None
    tuned_constant_variance_how: float | None = None
    tuned_noise_how: float | None = None
    tuned_lengthscale_user_how: float | None = None
    tuned_lengthscale_velocity_how: float | None = None
    tuned_lengthscale_laser_how: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class EventRow:
    """Something that happened in a live session beside what was applied."""

    participant: str
    lap: int | None
    step: int | None
    utc: str
    actor: str
    event: str
    note: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class SurveyRow:
    """One answer: a point of the scale, a number or text; all None where there is none."""

    participant: str
    lap: int
    condition: str
    instrument: str
    item: str
    response: int | None = None
    response_number: float | None = None
    response_text: str | None = None
    response_time_s: float | None = None


def response_fields(item: Item, answer: float | str | None, points: int) -> dict[str, Any]:
    """Return the columns in which an answer is recorded.

    Parameters
    ----------
    item
        What was asked.
    answer
        As given; None where the question was left out.
    points
        Of the instrument's scale.

    Raises
    ------
    ValueError
        When the answer is not of the item's kind, or out of its range.

    Examples
    --------
    >>> response_fields(Item(id="Q1", text="It was easy."), 4, 5)
    {'response': 4}
    """
    if answer is None:
        return {}
    if item.answer == "text" and isinstance(answer, str):
        return {"response_text": answer}
    if item.answer == "number" and isinstance(answer, int | float):
        low = -math.inf if item.lowest is None else item.lowest
        high = math.inf if item.highest is None else item.highest
        if low <= answer <= high and math.isfinite(answer) and item.on_a_step(answer):
            return {"response_number": float(answer)}
    if item.answer == "point" and isinstance(answer, int) and 1 <= answer <= points:
        return {"response": int(answer)}
    allowed = f"a point of 1 to {points}" if item.answer == "point" else f"a {item.answer}"
    raise ValueError(f"item {item.id}: {answer!r} is not an answer; allowed: {allowed}")
