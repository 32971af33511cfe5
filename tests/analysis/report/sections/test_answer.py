"""What the first screen says about equivalence."""

from dataclasses import replace

import pytest

from analysis.comparisons import declared_comparisons
from analysis.frames import study_frames
from analysis.report.sections.answer import _sentence
from analysis.stats.tost import paired_tost


@pytest.fixture
def alike(study):
    """Return the comparison with a declared margin, its differences small and symmetric."""
    (found,) = [c for c in declared_comparisons(study_frames(study)) if c.margin is not None]
    return replace(found, equivalence=paired_tost([-0.2, -0.1, 0.1, 0.2], found.margin))


@pytest.mark.parametrize(
    ("practice", "said"),
    [
        ("balanced", "is shown"),
        ("confounded", "is not concluded"),
        ("adjusted", "is not concluded"),
    ],
)
def test_equivalence_is_concluded_only_where_practice_cannot_hide_a_difference(
    alike, practice, said
):
    """TOST takes no place off: where place is not balanced a later lap may only seem alike."""
    sentence = _sentence(replace(alike, practice=practice))
    assert f"Equivalence within the declared margin of ±{alike.margin:g} s {said}" in sentence
    assert ("practice, which this test is not adjusted for" in sentence) == (said != "is shown")


def test_skewed_differences_are_said_beside_equivalence(alike):
    """One long tail: the sentence says that the test does not keep its level."""
    skewed = paired_tost([-0.2, -0.1, 0.0, 0.1, 0.2, 3.0], alike.margin)
    sentence = _sentence(replace(alike, equivalence=skewed))
    assert "The differences are skewed (" in sentence
    assert "skewed" not in _sentence(alike)
