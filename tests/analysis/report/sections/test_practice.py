"""The mixed model's section: a reason where there is no model, and the laps that are in it."""

import pytest

from analysis.report.sections.practice import practice_section
from analysis.results import analyse


def remarks(section):
    """Return everything the section says outside its tables."""
    said = [getattr(block, "text", "") for block in section.blocks]
    return "\n".join(said + [item for b in section.blocks for item in getattr(b, "items", ())])


@pytest.mark.parametrize(
    ("unfinished", "why"),
    [
        ({(i, 2) for i in range(1, 4)}, "no lap of limited, which the others are set against, has"),
        ({(i, lap) for i in range(1, 4) for lap in (1, 3, 4)}, "no lap of another condition than"),
    ],
    ids=["reference", "others"],
)
def test_why_there_is_no_model_is_true(make_study, unfinished, why):
    """The reference without a time is not the same as nothing to set against it."""
    study = make_study(participants=3, unfinished=frozenset(unfinished))
    assert f"There is no mixed model: {why}" in remarks(practice_section(analyse(study)))


def test_laps_left_out_of_the_model_are_counted(make_study):
    """Two unfinished laps of sixteen; numpy's own warnings are not shown."""
    study = make_study(participants=4, unfinished=frozenset({(1, 2), (2, 3)}))
    section = practice_section(analyse(study))
    text = remarks(section)
    assert "14 laps of 4 participants; 2 without a time left out." in text
    assert "encountered" not in text
    model = next(block for block in section.blocks if getattr(block, "name", "") == "mixed_model")
    pairs = model.header.index("pairs")
    assert {row[0].split()[0]: row[pairs] for row in model.rows} == {
        "baseline": "3",
        "human-assisted": "2",
        "model-assisted": "3",
    }


def test_a_contrast_says_how_many_have_both_of_its_laps(make_study):
    """The model takes those with one of the two laps, too; each own contrast has its remark."""
    text = remarks(practice_section(analyse(make_study(participants=4, unfinished={(1, 4)}))))
    assert "Model-assisted against limited: 3 of 4 participants have both." in text
    assert "Human-assisted against limited: " not in text
    assert "human-assisted against limited, own spread: paired t, 3 df, two-sided; standard" in text


def test_without_a_model_the_caption_describes_none(make_study):
    """One participant cannot be modelled."""
    section = practice_section(analyse(make_study(participants=1)))
    model = next(block for block in section.blocks if getattr(block, "name", "") == "mixed_model")
    assert "without a mixed model, for the reason below" in model.caption
    assert "too few: 4 laps of 1 participant." in remarks(section)
