"""Practice follows its power law, and splits between way and corners."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from participants.cohort import typical_traits
from participants.human.practice import skill

TRAITS = typical_traits()


@given(st.floats(0.0, 10.0), st.floats(0.0, 1.0), st.floats(0.0, 1.5), st.integers(0, 20))
def test_nobody_gets_worse(inexperience, share, exponent, lap):
    """Speeds rise and hesitations shrink from lap to lap, towards the practised ones."""
    traits = replace(
        TRAITS, inexperience=inexperience, corner_share=share, practice_exponent=exponent
    )
    now, later = skill(traits, lap), skill(traits, lap + 1)
    assert 0.0 < now.way <= later.way <= 1.0
    assert 0.0 < now.corner <= later.corner <= 1.0
    assert now.pause >= later.pause >= 0.0


def test_the_first_lap_shows_the_whole_inexperience():
    """On the way, an inexperience of 1 halves the speed when none of it sits in corners."""
    traits = replace(TRAITS, inexperience=1.0, corner_share=0.0)
    assert skill(traits, 0).way == pytest.approx(0.5)
    assert skill(traits, 0).corner == 1.0


def test_the_power_law():
    """With exponent 1 the second lap has half the excess time of the first."""
    traits = replace(TRAITS, inexperience=2.0, corner_share=0.0, practice_exponent=1.0)
    assert 1.0 / skill(traits, 1).way == pytest.approx(2.0)


def test_inexperience_in_corners_leaves_the_way_alone():
    """All of it in corners: the way is driven as practised, corners are not."""
    traits = replace(TRAITS, inexperience=1.0, corner_share=1.0, corner_pause_s=2.0)
    first = skill(traits, 0)
    assert (first.way, first.corner, first.pause) == (1.0, 0.5, 2.0)
