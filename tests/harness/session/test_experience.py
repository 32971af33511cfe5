"""A person's experience follows from the record of the laps."""

from dataclasses import replace

import pyarrow as pa
import pytest

from harness.session.experience import experience_of
from protocols.record.rows import LapRow
from protocols.record.session import RecordedLap

FREE = LapRow(
    participant="P0001",
    lap=1,
    condition="baseline",
    practice=False,
    limited=False,
    assistant="none",
    training=False,
    completed=True,
    end_reason="finished",
    lap_time_s=40.0,
    duration_s=40.0,
    steps=4,
    collisions=0,
    contact_time_s=0.0,
    assisted_fraction=0.0,
    interventions=0,
    gates_passed=3,
    seed=1,
)
HELPED = replace(
    FREE, lap=2, condition="h", limited=True, assistant="model", duration_s=50.0,
    assisted_fraction=0.5, interventions=1,
)  # fmt: skip


def lap(row, control=("driver",) * 4, arbitrated_w=(0.0,) * 4):
    """Return a recorded lap whose driver wants straight on to the right."""
    return RecordedLap(
        row,
        pa.table(
            {
                "control": list(control),
                "intent_v": [0.0] * 4,
                "intent_w": [-0.5] * 4,
                "arbitrated_v": [0.0] * 4,
                "arbitrated_w": list(arbitrated_w),
            }
        ),
    )


def test_times_are_compared_with_the_persons_own_baseline():
    """The reference is the person's own free lap, not the familiarisation before it."""
    practice = replace(FREE, practice=True, duration_s=90.0)
    experience = experience_of([lap(practice), lap(FREE), lap(HELPED)])
    assert (experience.lap_time, experience.baseline_time) == (50.0, 40.0)


def test_without_a_free_lap_there_is_no_yardstick():
    """A person who never drove freely has no baseline to compare with."""
    assert experience_of([lap(HELPED)]).baseline_time is None


def test_only_help_that_turns_the_other_way_interferes():
    """Of four helped steps two agree and one opposes: a quarter of the lap interfered."""
    control = ("model", "model", "model", "driver")
    experience = experience_of([lap(FREE), lap(HELPED, control, (-0.5, -0.2, 0.5, 0.5))])
    assert experience.interference == pytest.approx(0.25)
