"""A study's own rules of exclusion."""

from dataclasses import dataclass

import pytest

from protocols.declared import Exclusion
from protocols.exclusion import exclusion_reason


@dataclass
class _Lap:
    practice: bool = False
    completed: bool = True
    collisions: int = 0
    late_share: float | None = None
    input_age_p99_s: float | None = None
    pauses: int | None = None
    end_reason: str = "finished"


_LAPS = [
    _Lap(practice=True, collisions=9),
    _Lap(collisions=2, late_share=0.25, input_age_p99_s=0.4),
    _Lap(completed=False, collisions=1, pauses=1),
]


@pytest.mark.parametrize(
    ("rules", "reason"),
    [
        (Exclusion(), None),
        (Exclusion(min_completed_laps=1, max_collisions=3), None),
        (Exclusion(min_completed_laps=2), "completed 1 laps; the protocol asks for 2"),
        (Exclusion(max_collisions=2), "3 collisions; the protocol allows 2"),
        (Exclusion(max_collisions=0), "3 collisions; the protocol allows 0"),
        (
            Exclusion(max_late_share=0.2),
            "25.0% of a lap's steps were late; the protocol allows 0.2",
        ),
        (Exclusion(max_late_share=0.25, max_input_age_s=0.5, max_interruptions=1), None),
        (Exclusion(max_input_age_s=0.3), "inputs were 0.40 s old; the protocol allows 0.3 s"),
        (Exclusion(max_interruptions=0), "1 laps interrupted; the protocol allows 0"),
    ],
)
def test_the_rule_that_applies_is_named(rules: Exclusion, reason: str | None):
    """Practice laps never count; the first rule that applies is given in words."""
    assert exclusion_reason(rules, _LAPS) == reason
