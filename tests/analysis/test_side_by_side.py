"""Living and synthetic people stand side by side, from two studies or one."""

import pytest

from analysis.frames import study_frames
from analysis.report.write import write_results
from analysis.results import analyse
from analysis.side_by_side import side_by_side
from protocols.files.errors import InputError


@pytest.fixture
def living(make_study):
    """Return a made-up study of four living people."""
    return make_study(living=True)


def test_each_condition_has_both_kinds_of_people(living, study):
    """Times and agreement of each group are those of its own study."""
    here, there = study_frames(living), study_frames(study)
    found = side_by_side(here, there)
    assert found.groups == ("living", "synthetic")
    times = found.times.set_index(["condition", "people"])["mean"]
    for people, frames in (("living", here), ("synthetic", there)):
        own = frames.laps[frames.laps["condition"] == "limited"]["lap_time_s"]
        assert times["limited", people] == pytest.approx(own.mean())
    agree = found.answers.set_index(["item", "condition", "people"])["agree_percent"]
    answers = here.surveys
    own = answers[(answers["item"] == "Q1") & (answers["condition"] == "baseline")]["response"]
    assert agree["Q1", "baseline", "living"] == pytest.approx(100 * (own >= 4).mean())


def test_two_studies_of_one_kind_are_told_apart(study):
    """Synthetic people of two studies are two groups, not one."""
    frames = study_frames(study)
    found = side_by_side(frames, study_frames(study))
    assert found is not None
    assert found.groups == ("synthetic (this study)", "synthetic (beside)")


def test_one_kind_alone_stands_beside_nobody(study):
    """A study as it always was has no such section."""
    assert side_by_side(study_frames(study)) is None


def test_studies_without_a_common_condition_are_refused(living, write_made_up, tmp_path):
    """In one line, with what is allowed."""
    other = write_made_up(tmp_path / "other", "recovery", 2)
    with pytest.raises(InputError, match=r"has no condition of .*; allowed: a study with one of"):
        side_by_side(study_frames(living), study_frames(other))


def test_the_report_shows_them(living, study):
    """The page has the section with both figures."""
    page = write_results(analyse(living, beside=study))
    assert "Living and synthetic people side by side" in page.read_text()
    for name in ("side_by_side", "answers_side_by_side"):
        assert (page.parent / "figures" / f"{name}.svg").exists()
