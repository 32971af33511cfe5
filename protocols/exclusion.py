"""Whether a study's own rules exclude a participant."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple, Protocol

from protocols.declared import Exclusion

BROKEN_OFF = ("stopped", "disconnected", "interrupted")
"""Ends of a lap that are neither the participant's driving nor their wish."""


class DrivenLap(Protocol):
    """What the rules need to know of a lap."""

    @property
    def practice(self) -> bool:
        """Whether the lap is left out of the analysis."""

    @property
    def completed(self) -> bool:
        """Whether the lap reached its last gate."""

    @property
    def collisions(self) -> int:
        """Number of contacts with obstacles."""

    @property
    def end_reason(self) -> str:
        """Why the lap ended."""

    @property
    def late_share(self) -> float | None:
        """Share of steps that started late; None in simulated time."""

    @property
    def input_age_p99_s(self) -> float | None:
        """99th percentile of the age of the driver's command, s; None for a simulated driver."""

    @property
    def pauses(self) -> int | None:
        """How often the lap was paused; None in simulated time."""


def exclusion_reason(rules: Exclusion, laps: Iterable[DrivenLap]) -> str | None:
    """Return the rule that excludes a participant, in words; None when none applies.

    Parameters
    ----------
    rules
        The protocol's rules.
    laps
        The laps the participant drove; practice laps are left out.
    """
    counted = [lap for lap in laps if not lap.practice]
    completed = sum(lap.completed for lap in counted)
    if rules.min_completed_laps is not None and completed < rules.min_completed_laps:
        return f"completed {completed} laps; the protocol asks for {rules.min_completed_laps}"
    collisions = sum(lap.collisions for lap in counted)
    if rules.max_collisions is not None and collisions > rules.max_collisions:
        return f"{collisions} collisions; the protocol allows {rules.max_collisions}"
    return _poor_link(rules, counted)


def _poor_link(rules: Exclusion, laps: Sequence[DrivenLap]) -> str | None:
    """Return the rule about a living person's link that applies, in words."""
    late, age, interrupted = link_of(laps)
    if rules.max_late_share is not None and late > rules.max_late_share:
        return f"{late:.1%} of a lap's steps were late; the protocol allows {rules.max_late_share}"
    if rules.max_input_age_s is not None and age > rules.max_input_age_s:
        return f"inputs were {age:.2f} s old; the protocol allows {rules.max_input_age_s} s"
    if rules.max_interruptions is not None and interrupted > rules.max_interruptions:
        return f"{interrupted} laps interrupted; the protocol allows {rules.max_interruptions}"
    return None


class Link(NamedTuple):
    """How well a living person was connected, as the rules measure it.

    Attributes
    ----------
    late_share
        Largest share of late steps in a lap, in [0, 1].
    input_age_s
        Largest 99th percentile in a lap of the age of the driver's command, s.
    interruptions
        How many laps were paused, stopped or disconnected.
    """

    late_share: float
    input_age_s: float
    interruptions: int


def link_of(laps: Iterable[DrivenLap]) -> Link:
    """Return how well a person was connected in some laps; 0 where nothing is known."""
    known = list(laps)
    return Link(
        max((lap.late_share or 0.0 for lap in known), default=0.0),
        max((lap.input_age_p99_s or 0.0 for lap in known), default=0.0),
        sum(bool(lap.pauses) or lap.end_reason in BROKEN_OFF for lap in known),
    )
