"""What a protocol may say, and what contradicts itself."""

from typing import Any

import pytest
from pydantic import ValidationError

from lad.hyperparameters import LADParameters
from protocols.consistency import check_consistency
from protocols.files.fault import InconsistentError
from protocols.study import StudyProtocol

_LIMIT = {"right_turn_rad_s": 0.15}
_CONDITIONS: dict[str, Any] = {
    "baseline": {},
    "limited": {"limitation": _LIMIT},
    "taught": {"limitation": _LIMIT, "assistant": "demonstrator", "training": True},
    "helped": {"limitation": _LIMIT, "assistant": "model"},
}


def _study(*laps: Any, **fields: Any) -> StudyProtocol:
    planned = [{"condition": lap} if isinstance(lap, str) else lap for lap in laps]
    values = {"name": "s", "title": "S", "conditions": _CONDITIONS, "laps": planned, **fields}
    return StudyProtocol.model_validate(values)


def _faults(*laps: Any, **fields: Any) -> dict[str, str]:
    with pytest.raises(ValidationError) as caught:
        _study(*laps, **fields)
    cause = caught.value.errors()[0]["ctx"]["error"]
    assert isinstance(cause, InconsistentError)
    return {".".join(map(str, fault.where)): fault.message for fault in cause.faults}


def test_equivalence_is_of_means_not_of_answers():
    """Answers on five points have no mean to be tested."""
    analysis = {
        "name": "a", "outcome": "driving-assistance.Q7", "condition": "limited",
        "reference": "baseline", "equivalence_margin": 1.0,
    }  # fmt: skip
    faults = _faults("baseline", "limited", analyses=[analysis])
    assert "answers (driving-assistance.Q7) do not have" in faults["analyses.0.equivalence_margin"]


def test_defaults_are_the_papers():
    """Twelve participants from the paper's sample, Table I, takeover with the safeguard on."""
    study = _study("limited")
    assert study.cohort.participants == 12
    assert study.cohort.demographics.age_years.mean == 27
    assert study.model.parameters == LADParameters()
    condition = study.conditions[study.laps[0].condition]
    assert (condition.safeguard, condition.arbitration, condition.assistant) == (
        True, "takeover", "none")  # fmt: skip


def test_a_condition_may_be_driven_twice():
    """Repeated laps of one condition are a design, not a mistake."""
    assert len(_study("limited", "taught", "limited", "helped", "helped").laps) == 5


def test_a_study_cannot_be_changed():
    """A protocol is frozen: nothing changes a study while it runs."""
    with pytest.raises(ValidationError, match="frozen"):
        _study("limited").name = "other"


def test_training_needs_a_demonstrator():
    """A lap without a demonstrator cannot be a training lap."""
    with pytest.raises(ValidationError, match="needs assistant: demonstrator"):
        _study("a", conditions={"a": {"assistant": "model", "training": True}})


def test_an_unknown_condition_is_the_only_fault():
    """A misspelt lap does not set off faults about what the lap would have provided."""
    faults = _faults("limited", "tought", "helped", analyses=[
        {"name": "a", "condition": "helped", "reference": "taught"}])  # fmt: skip
    assert list(faults) == ["laps.1.condition"]
    assert "did you mean 'taught'" in faults["laps.1.condition"]


def test_the_model_must_have_learnt():
    """A lap that the model assists needs a training lap before it, not after."""
    assert list(_faults("helped", "taught")) == ["laps.0.condition"]
    assert list(_faults("limited", "helped")) == ["laps.1.condition"]


def test_a_model_of_ones_own_may_know_something_beforehand():
    """Only of the shipped one is it known that an untaught lap can have no help."""
    study = _study("helped", model={"use": "lad.trained:load", "options": {"path": "m.npz"}})
    assert [lap.condition for lap in study.laps] == ["helped"]


def test_not_every_lap_may_be_practice():
    """A study without a lap to analyse is refused."""
    faults = _faults({"condition": "limited", "practice": True})
    assert faults == {"laps": "every lap is practice; at least one must not be"}


def test_questions_are_asked_once_after_a_lap():
    """The same instrument or item twice after one lap is refused."""
    twice = {"condition": "limited", "survey": [{"instrument": "x"}, {"instrument": "x"}]}
    assert list(_faults(twice)) == ["laps.0.survey.1.instrument"]
    item = {"condition": "limited", "survey": [{"instrument": "x", "items": ["Q1", "Q2", "Q1"]}]}
    assert list(_faults(item)) == ["laps.0.survey.0.items.2"]


def test_comparisons_name_laps_that_are_analysed():
    """Unknown, undriven, practised and identical conditions, and repeated names, are refused."""
    laps = ({"condition": "baseline", "practice": True}, "limited")
    pairs = [("limited", "nowhere"), ("helped", "limited"), ("limited", "baseline"),
             ("limited", "limited")]  # fmt: skip
    analyses = [{"name": str(i), "condition": c, "reference": r} for i, (c, r) in enumerate(pairs)]
    faults = _faults(*laps, analyses=[*analyses, {**analyses[3], "name": "0"}])
    assert list(faults) == [
        "analyses.0.reference",
        "analyses.1.condition",
        "analyses.2.reference",
        "analyses.3.reference",
        "analyses.4.name",
        "analyses.4.reference",
    ]


def test_an_outcome_is_a_lap_column_or_an_item():
    """Lap outcomes have no item; the others name instrument and item; nonsense is refused."""
    laps, pair = ("limited", "baseline"), {"condition": "limited", "reference": "baseline"}
    analyses = [{"name": "a", **pair}, {"name": "b", "outcome": "my.scale.Q7", **pair}]
    items = [comparison.item for comparison in _study(*laps, analyses=analyses).analyses]
    assert items == [None, ("my.scale", "Q7")]
    with pytest.raises(ValidationError, match="'speed' is not an outcome; allowed: lap_time_s"):
        _study(*laps, analyses=[{"name": "a", "outcome": "speed", **pair}])


def test_options_are_for_a_model_of_ones_own():
    """The shipped model takes parameters, your own takes options."""
    with pytest.raises(ValidationError, match="lad takes parameters"):
        _study("limited", model={"options": {"k": 3}})
    other = _study("limited", model={"use": "my.lab:model", "options": {"k": 3}})
    assert other.model.options == {"k": 3}


def test_a_learnt_level_needs_a_model_that_learns_one():
    """Also where a group has a model of its own; a model of one's own may learn one."""
    shared = {"limited": {}, "taught": {"assistant": "demonstrator", "training": True},
              "shared": {"assistant": "model", "arbitration": "blend-learnt"}}  # fmt: skip
    laps = ("limited", "taught", "shared")
    for use in ("lad-level", "my.lab:model"):
        assert _study(*laps, conditions=shared, model={"use": use}).model.use == use
    with pytest.raises(ValidationError, match="lad-correction learns no level of assistance"):
        _study(*laps, conditions=shared, model={"use": "lad-correction"})
    borrowed = shared | {"shared": shared["shared"] | {"model": "pilot"}}
    models = {"pilot": {"from": "pilot"}}
    with pytest.raises(ValidationError, match="lad learns no level of assistance"):
        _study(*laps, conditions=borrowed, models=models)
    groups = {"a": {}, "b": {"model": {"use": "lad"}}}
    with pytest.raises(ValidationError, match="lad learns no level of assistance"):
        _study(*laps, conditions=shared, model={"use": "lad-level"}, groups=groups)


@pytest.mark.parametrize("use", ["lad", "lad-correction", "lad-level"])
def test_a_shipped_model_has_to_be_taught_before_it_helps(use):
    """Whichever it is."""
    with pytest.raises(ValidationError, match="has learnt nothing yet"):
        _study("limited", "helped", model={"use": use})


def test_ages_must_be_possible():
    """A mean outside the range, and an sd no distribution in the range has, are refused."""
    for age in ({"mean": 50}, {"sd": 12}):
        with pytest.raises(ValidationError, match=r"mean age must lie|no distribution"):
            _study("limited", cohort={"demographics": {"age_years": age}})


def test_a_right_plan_has_no_faults():
    """The check finds no fault in a protocol whose parts agree."""
    study = _study("baseline", "limited", "taught", "helped")
    check_consistency(study.conditions, study.laps, study.analyses, cohort=study.cohort)
