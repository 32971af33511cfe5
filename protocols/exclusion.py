"""Whether a study's own rules exclude a participant."""

from collections.abc import Iterable
from typing import Protocol

from protocols.declared import Exclusion


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
    return None
