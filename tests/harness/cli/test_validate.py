"""`validate` refuses what `run` would refuse, with file, line and place, and makes what ships."""

import pytest

PROTOCOL = """\
schema: 1
name: mine
title: A study
conditions: {baseline: {}}
laps: [{condition: baseline, time_limit_s: 1SURVEY}]
cohort:
  participants: 1
COHORT
"""

OWN = """\
schema: 1
name: own
title: Own questions
anchors: [no, maybe, yes]
agreement_from: 3
items: [{id: Q1, text: Was it fun?}]
"""


@pytest.mark.parametrize(
    ("cohort", "survey", "parts"),
    [
        ("  driver: {use: autonomous, options: {control_noise: 5}}", "", [":8: ", "control_noise"]),
        ("  driver: {use: scripted}", "", [":8: ", "either file or commands"]),
        ("  driver: {use: scripted, options: {file: no.csv}}", "", ["no.csv", "No such file"]),
        ("  driver: {use: human, options: {speed: 9}}", "", [":8: ", "speed"]),
        ("  traits: {nonsense: {median: 5, spread: 1}}", "", [":8: ", "nonsense"]),
        ("  demonstrator: {options: {pace: 9}}", "", [":8: ", "pace"]),
        ("  impairments: [{use: tremor, share: 0, options: {f: 1}}]", "", [":8: ", "'f'"]),
        ("model: {use: linear, options: {size: 1}}", "", [":8: model", "size"]),
        ("model: {use: taught, options: {path: no.npz}}", "", [":8: model", "no.npz"]),
        ("", ", survey: [{instrument: own.yaml}]", ["mine.yaml:6: cohort", "Q1", "loadings"]),
    ],
)
def test_what_run_refuses_validate_refuses_in_the_same_words(
    lad_study, tmp_path, cohort, survey, parts
):
    """Options of every part, traits, and items that nobody can answer."""
    (tmp_path / "own.yaml").write_text(OWN)
    text = PROTOCOL.replace("COHORT", cohort).replace("SURVEY", survey)
    (tmp_path / "mine.yaml").write_text(text)
    validated = lad_study("validate", "mine.yaml")
    assert validated.code == 2
    assert validated.err.count("\n") == 1
    for part in parts:
        assert part in validated.err
    ran = lad_study("run", "mine.yaml", "--no-report")
    assert ran.code == 2
    assert ran.err == validated.err
    assert not (tmp_path / "studies").exists()


def test_every_part_is_made_once(lad_study, tmp_path, monkeypatch):
    """Not once more for every impairment."""
    from harness.session import parts

    made = []
    for name in ("make_driver", "make_demonstrator", "make_respondent", "make_impaired"):
        real = getattr(parts, name)
        monkeypatch.setattr(
            parts, name, lambda use, *more, real=real: made.append(use) or real(use, *more)
        )
    cohort = "  impairments: [{use: tremor, share: 0.1}, {use: weakness, share: 0.1}]"
    text = PROTOCOL.replace("COHORT", cohort).replace("SURVEY", "")
    (tmp_path / "mine.yaml").write_text(text)
    assert lad_study("validate", "mine.yaml").code == 0
    assert sorted(made) == ["attentive", "human", "ordinal", "tremor", "weakness"]
