"""`run` says when a study is of no use, also to a script that reads its exit code alone."""

BRIEF = """\
schema: 1
name: brief
title: A lap that is too short
cohort: {participants: 1, driver: {use: autonomous}}
conditions: {baseline: {}}
laps: [{condition: baseline, time_limit_s: 0.3}]
"""


def test_a_condition_nobody_finished_ends_in_exit_code_1(lad_study, tmp_path):
    """With a sentence and the likely reason, when it is run and when it is found finished."""
    (tmp_path / "brief.yaml").write_text(BRIEF)
    for _ in range(2):
        said = lad_study("run", "brief.yaml", "--no-report", "--jobs", 1, "--out", "study")
        assert said.code == 1
        assert "Nobody finished a lap of baseline (1 begun): 1 ended by the time limit" in said.err
        assert said.err.count("Nobody finished") == 1
