"""The methods text says what was done: no sentence without its analysis, and the reverse."""

import re

import pytest

from analysis.report.sections.methods import methods_section
from analysis.results import analyse

PROTOCOL = """
schema: 1
name: two
title: Two conditions
course: lab-office
cohort: {participants: 4}
conditions:
  free: {}
  limited: {limitation: {right_turn_rad_s: 0.15}}
laps:
  - {condition: free, practice: true}
  - condition: free
  - condition: limited
exclusion: {max_collisions: 40}
analyses:
  - {name: alike, condition: limited, reference: free, kind: confirmatory, equivalence_margin: 5}
"""


def text_of(study):
    """Return the methods of a study as one text."""
    return "\n".join(block.text for block in methods_section(analyse(study)).blocks)


def test_the_default_protocol_is_described_as_it_is_declared(study):
    """Every declared comparison, each with its kind; both helpers' maps; the questionnaire."""
    text = text_of(study)
    for declared in study.protocol.analyses:
        assert f"{declared.name} ({declared.outcome}, {declared.condition} − " in text
    assert "Nobody was excluded." in text
    assert "Wilcoxon signed-rank, exact, two-sided" in text
    assert "sources exchanged within participants, exact" in text
    assert "drawn from a model with assumed loadings" in text


def test_what_a_study_declares_is_in_its_methods_and_nothing_else(make_study, tmp_path):
    """A margin, a rule and practice laps: said. Maps, model and questionnaire: there are none."""
    path = tmp_path / "two.yaml"
    path.write_text(PROTOCOL)
    text = text_of(make_study(path, participants=4))
    assert "alike (lap_time_s, limited − free; confirmatory, family 'primary', equiv" in text
    assert "(TOST), with 90% intervals" in text
    assert "from every analysis participants who collided more than 40 times" in text
    assert "Practice laps were not analysed." in text
    assert not re.search(r"map|p\(h|shadow|items|Cronbach|overlap", text)
    assert "bootstrap" not in text  # four people have no bootstrap interval


@pytest.mark.parametrize(
    ("events", "said"),
    [
        ({"participants": 4}, False),
        ({"participants": 4, "unfinished": frozenset({(1, 2)})}, True),
    ],
)
def test_unfinished_laps_are_spoken_of_where_there_are_any(make_study, events, said):
    """How they count is a matter only then."""
    text = text_of(make_study(**events))
    assert ("Only finished laps have a lap time" in text) is said
    assert ("left out of its comparison and counted" in text) is said


def test_one_participant_is_described_without_tests(make_study):
    """Nothing was fitted or resampled, and no sentence claims so."""
    text = text_of(make_study(participants=1))
    assert not re.search(r"REML|bootstrap|overlap coefficient|confidence", text)


def test_exclusions_are_given_with_their_reasons(make_study):
    """Whatever excluded somebody: a rule, or the hand of who recorded the study."""
    text = text_of(make_study(participants=4, excluded={1: "fell asleep", 2: "fell asleep"}))
    assert "Excluded: fell asleep: 2." in text
