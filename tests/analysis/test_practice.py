"""How much practice alone would have to do."""

import math
from dataclasses import replace

import numpy as np
import pytest

from analysis.frames import study_frames
from analysis.practice import order_confounded, other_orders, practice_table
from analysis.results import analyse
from analysis.stats.result import TestResult


def contrast(name, estimate, low, high):
    """Return a contrast of the mixed model."""
    return TestResult(name=name, n=12, estimate=estimate, low=low, high=high)


def test_the_four_lap_order_is_confounded(study):
    """Every condition has its own place in the session."""
    assert order_confounded(study_frames(study))


def test_who_drove_another_order_is_counted(study):
    """Two laps swapped by one person; a lap that was left out is no other order."""
    frames = study_frames(study)
    people = frames.laps["participant"].nunique()
    assert other_orders(frames) == (0, people)
    laps = frames.laps.copy()
    first = laps["participant"] == laps["participant"].iloc[0]
    place = laps["lap"].where(~first, laps["lap"].max() - laps["lap"])
    assert other_orders(replace(frames, laps=laps.assign(lap=place))) == (1, people)
    assert other_orders(replace(frames, laps=laps[~first | (laps["lap"] > 2)])) == (0, people)


def test_without_practice_nothing_changes(study):
    """An assumed saving of zero leaves the model's ratio."""
    found = contrast("model-assisted against limited", -0.3, -0.4, -0.2)
    table = practice_table(study_frames(study), [found])
    none = table[table["practice_percent"] == 0].iloc[0]
    assert none["ratio"] == pytest.approx(math.exp(-0.3))
    assert (none["ratio_low"], none["ratio_high"]) == pytest.approx(
        (math.exp(-0.4), math.exp(-0.2))
    )


def test_practice_that_explains_a_difference_brings_its_interval_to_one(study):
    """Two laps apart: a saving of g per lap multiplies the ratio by (1 - g)^-2."""
    found = contrast("model-assisted against limited", -0.3, -0.4, -0.2)
    table = practice_table(study_frames(study), [found])
    assert table["laps_apart"].unique() == [2.0]
    saving = table["explains_percent"].iloc[0] / 100
    assert math.exp(-0.2) / (1 - saving) ** 2 == pytest.approx(1.0)
    ten = table[table["practice_percent"] == 10].iloc[0]
    assert ten["ratio"] == pytest.approx(math.exp(-0.3) / 0.9**2)


def test_practice_cannot_explain_that_a_later_lap_is_slower(study):
    """The limitation costs time although practice works against it."""
    found = contrast("baseline against limited", -0.4, -0.5, -0.3)
    table = practice_table(study_frames(study), [found])
    assert table["laps_apart"].unique() == [-1.0]
    assert table["explains_percent"].isna().all()


def test_no_difference_needs_no_explanation(study):
    """An interval that holds 1 is explained by nothing at all."""
    found = contrast("model-assisted against limited", -0.1, -0.3, 0.1)
    table = practice_table(study_frames(study), [found])
    assert (table["explains_percent"] == 0).all()


def test_the_models_contrasts_are_set_against_limited(study):
    """Mixed model, overlap and composite scores of a whole study are all there."""
    results = analyse(study)
    assert {c.name for c in results.model} == {
        f"{c} against limited" for c in ("baseline", "human-assisted", "model-assisted")
    }
    assert 0 < results.overlap.estimate <= 1
    assert len(results.practice) == 3 * 6
    assert np.isfinite(results.surveys[0].scales["mean"]).all()
