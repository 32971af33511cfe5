"""Groups that drive different courses, from the file to the report."""

import pytest

from protocols.record.reader import open_study

TWO_COURSES = """\
schema: 1
name: two-courses
title: Two courses
course: lab-office
cohort: {participants: 4, driver: {use: autonomous}, respondent: null}
conditions:
  one: {}
  two: {limitation: {right_turn_rad_s: 0.4}}
laps:
  - {condition: one, time_limit_s: 2}
  - {condition: two, time_limit_s: 2}
groups:
  here: {}
  there: {course: ward-corridor}
analyses:
  - {name: there it takes longer, condition: one, groups: [there, here], kind: confirmatory}
"""


def test_a_groups_course_must_be_there(lad_study, tmp_path):
    """One line with file, line, field and the courses there are."""
    (tmp_path / "wrong.yaml").write_text(TWO_COURSES.replace("ward-corridor", "ward-coridor"))
    said = lad_study("validate", "wrong.yaml")
    assert said.code == 2
    assert "groups.there.course" in said.err
    assert "ward-corridor" in said.err


def test_validate_names_each_groups_course(lad_study, tmp_path):
    """The study's own course, and that of the group that has another one."""
    (tmp_path / "two.yaml").write_text(TWO_COURSES)
    said = lad_study("validate", "two.yaml")
    assert said.code == 0
    assert "2 laps on lab-office" in said.out
    assert "Groups: there drives ward-corridor." in said.out


@pytest.mark.slow
def test_each_group_drives_its_own_course(lad_study, tmp_path):
    """Two people start where each course has its start; the record is whole, the report says so."""
    (tmp_path / "two.yaml").write_text(TWO_COURSES)
    ran = lad_study("run", "two.yaml", "--jobs", "1", "--out", "study")
    assert (ran.code, "Nobody finished" in ran.err) == (1, True)  # two seconds are too short
    assert lad_study("check", "study").code == 0
    study = open_study(tmp_path / "study")
    groups = dict(
        zip(*(study.participants[c].to_pylist() for c in ("participant", "group")), strict=True)
    )
    assert sorted(groups.values()) == ["here", "here", "there", "there"]
    for who, group in groups.items():
        course = study.course_of(who)
        assert course.name == {"here": "lab-office", "there": "ward-corridor"}[group]
        start = study.steps(who, 0, ["x_m", "y_m"]).slice(0, 1).to_pylist()[0]
        assert start["x_m"] == pytest.approx(course.start.x, abs=0.3)
        assert start["y_m"] == pytest.approx(course.start.y, abs=0.3)
    page = (tmp_path / "study" / "report" / "index.html").read_text(encoding="utf-8")
    assert "There it takes longer (confirmatory, between groups)" in page
    assert "course lab-office and ward-corridor" in page
    assert "drove course" in page
