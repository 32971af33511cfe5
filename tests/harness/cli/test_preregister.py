"""From a plan to a study that follows it, on the command line."""

import pytest

from protocols.record.header import read_header
from protocols.registration import read_registration

SHORT = """\
schema: 1
name: short
title: A short study
cohort: {participants: 2, driver: {use: autonomous}, respondent: null}
conditions:
  one: {}
  two: {limitation: {right_turn_rad_s: 0.4}}
laps:
  - {condition: one, time_limit_s: 2}
  - {condition: two, time_limit_s: 2}
orders: latin
analyses:
  - {name: two is slower, condition: two, reference: one, kind: confirmatory}
"""


def test_validate_says_what_the_orders_balance_and_what_is_out_of_reach(lad_study, tmp_path):
    """Two people: no signed-rank test can be significant."""
    (tmp_path / "short.yaml").write_text(SHORT)
    said = lad_study("validate", "short.yaml")
    assert said.code == 0
    assert "2 orders of 2 conditions, all of which can be driven" in said.out
    assert "Caution: with 2 participants nothing in family 'primary'" in said.out
    assert "6 complete pairs are needed" in said.out


@pytest.mark.slow
def test_a_study_follows_its_registration_and_no_other_plan(lad_study, tmp_path):
    """Run, report, check; another number of participants is refused, a changed byte is found."""
    (tmp_path / "short.yaml").write_text(SHORT)
    assert lad_study("preregister", "short.yaml", "--out", "plan").code == 0
    refused = lad_study("run", "short.yaml", "--registration", "plan", "--participants", "3")
    assert refused.code == 2
    assert "stops at 2" in refused.err
    run = ("run", "short.yaml", "--registration", "plan", "--jobs", "1", "--out", "study")
    ran = lad_study(*run)
    assert ran.code == 1
    assert "Nobody finished a lap of one (2 begun)" in ran.err
    digest = read_registration(tmp_path / "plan").digest
    page = (tmp_path / "study" / "report" / "index.html").read_text(encoding="utf-8")
    assert f"plan {digest[:12]}" in page
    assert lad_study("check", "study").code == 0
    plan = tmp_path / "study" / "registration" / "plan.json"
    plan.write_bytes(plan.read_bytes() + b" ")
    found = lad_study("check", "study")
    assert found.code == 1
    assert "changed since it was registered" in found.out


@pytest.mark.slow
def test_an_amendment_takes_effect_in_a_study_under_way(lad_study, tmp_path):
    """Two sessions before, two after: one directory, whole, and the report names which were which.

    Without the amendment the changed plan is refused.
    """
    path = tmp_path / "short.yaml"
    path.write_text(SHORT)
    assert lad_study("preregister", "short.yaml", "--out", "plan").code == 0
    run = ("run", "short.yaml", "--registration", "plan", "--jobs", "1", "--out", "study")
    assert lad_study(*run).code == 1  # in two seconds nobody finishes a lap
    before = read_header(tmp_path / "study")
    path.write_text(SHORT.replace("participants: 2", "participants: 4") + "hold_s: 0.4\n")
    refused = lad_study(*run)
    assert (refused.code, "hold_s" in refused.err) == (2, True)
    amend = ("preregister", "short.yaml", "--out", "plan", "--amend", "the link is slow")
    assert lad_study(*amend).code == 0
    done = lad_study(*run)
    assert done.code == 1
    assert "2 sessions were before it" in done.out
    after = read_header(tmp_path / "study")
    assert (after.digest, after.protocol.hold_s) == (before.digest, 0.4)
    assert after.amended[0].sessions == ("P0001", "P0002")
    page = (tmp_path / "study" / "report" / "index.html").read_text(encoding="utf-8")
    assert "2 of 4 sessions before the last one" in page
    assert "Before it: 2 (P0001, P0002); after it: 2 (P0003, P0004)" in page
    assert lad_study("check", "study").code == 0
    assert "4 of 4 sessions were there already" in lad_study(*run).out
