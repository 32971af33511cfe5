"""Studies unlike the four laps: repeated conditions, two models, no assistance at all."""

import pytest

from analysis.frames import study_frames
from analysis.report.page import build_page
from analysis.results import analyse

HEAD = """
schema: 1
name: other
title: Another study
replicates: soh-demiris-2013
course: lab-office
cohort: {participants: 2, driver: {use: DRIVER}}
conditions:
  free: {}
  limited: {limitation: {right_turn_rad_s: 0.15}}
  taught: {limitation: {right_turn_rad_s: 0.15}, assistant: demonstrator, training: true}
  after one: {limitation: {right_turn_rad_s: 0.15}, assistant: model}
  after three: {limitation: {right_turn_rad_s: 0.15}, assistant: model}
laps:
"""


@pytest.fixture
def page(make_study, tmp_path, page_text):
    """Return a function from a driver and the conditions of the laps to results and page text."""

    def write(driver, *conditions):
        path = tmp_path / "other.yaml"
        laps = "".join(f"  - condition: {c}\n" for c in conditions)
        path.write_text(HEAD.replace("DRIVER", driver) + laps)
        results = analyse(make_study(path, participants=2))
        built = build_page(results)
        return results, page_text(built)

    return write


ROBOT = ("free", "limited", "taught", "after one", "taught", "taught", "after three")


def test_autonomous_drivers_are_set_against_section_iv(page):
    """Lap times after one and three demonstrations, and the paper's KS distance."""
    results, _ = page("autonomous", *ROBOT)
    paper = results.paper.set_index("what")["paper"]
    assert paper["after one: mean lap time"] == 42.6
    assert paper["after three: mean lap time"] == 40.4
    assert paper["after three: Kolmogorov-Smirnov distance from taught"] == 0.3125
    assert results.paper["section"].str.startswith("IV").all()


def test_repeated_laps_of_a_condition_are_averaged_before_pairing(page):
    """Six taught laps of two people make two pairs; all six are in the lap times."""
    results, text = page("autonomous", *ROBOT)
    frames = study_frames(results.frames.study)
    assert (frames.laps["condition"] == "taught").sum() == 6
    taught = next(
        c for c in results.lap_times if (c.condition, c.reference) == ("taught", "limited")
    )
    assert taught.complete == 2
    assert "taught" in text


def test_a_study_that_declares_nothing_is_exploratory(page):
    """The answer shows what helped against the limited laps, and calls it not declared."""
    results, text = page("human", "free", "limited", "taught", "after one")
    assert results.declared == ()
    assert "no confirmatory comparison" in text
    assert "(not declared)" in text
    assert "Nothing was asked in this study" in text


def test_a_study_without_assistance_has_no_maps(page):
    """Two laps without an assistant: the page states it."""
    results, text = page("human", "free", "limited")
    assert results.overlap is None
    assert "No condition of this study has an assistant" in text


def test_a_repeated_limited_lap_does_not_tell_the_shape_of_practice(page):
    """Limited first and last: practice between them can be told only if it is a straight line.

    It is none, so the places stay out of the model, the caution and the table stay.
    """
    results, text = page("human", "limited", "taught", "after one", "limited")
    assert all("place is not identified" in contrast.method for contrast in results.model)
    assert not results.practice.empty
    assert "practice and condition are confounded" in text


def test_one_condition_alone_has_nothing_to_compare(page):
    """The page is written, and says that there is nothing to compare."""
    results, text = page("human", "free")
    assert results.lap_times == ()
    assert "it declares no comparison" in text
    assert "no lap of another condition than free has a time" in text
