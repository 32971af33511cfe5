"""A study to run."""

from dataclasses import dataclass

from protocols.resolved import ResolvedStudy


@dataclass(frozen=True, slots=True)
class Plan:
    """Everything a session depends on, besides the participant's number."""

    study: ResolvedStudy
    seed: int
