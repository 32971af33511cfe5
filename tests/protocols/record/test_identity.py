"""What makes two studies the same."""

from dataclasses import replace
from typing import Any

from protocols.files.dump import to_yaml
from protocols.groups import Group
from protocols.load import resolve_study
from protocols.record.identity import differences, identity, study_digest
from protocols.resolved import ResolvedStudy
from protocols.study import LaserSettings


def _with(plan: ResolvedStudy, **changes: Any) -> ResolvedStudy:
    return replace(plan, protocol=plan.protocol.model_copy(update=changes))


def test_the_number_of_participants_is_not_part_of_it(plan: ResolvedStudy):
    """A study can be enlarged."""
    larger = resolve_study("four-lap", participants=50)
    assert study_digest(plan, 0) == study_digest(larger, 0)
    assert differences(plan, 0, larger, 0) == ()


def test_everything_else_is(plan: ResolvedStudy):
    """Seed, protocol, course and instruments change the digest, and are named as differences."""
    course = plan.course.model_copy(update={"title": "other"})
    instrument = plan.instruments[0].model_copy(update={"source": ""})
    title = plan.course.title
    cases = [
        ("seed: 0 there, 1 wanted", plan, 1),
        (
            "protocol.control_period_s: 0.1 there, 0.05 wanted",
            _with(plan, control_period_s=0.05),
            0,
        ),
        (
            "protocol.laps: 5 entries there, 2 entries wanted",
            _with(plan, laps=plan.protocol.laps[:2]),
            0,
        ),
        (f"course.title: {title!r} there, 'other' wanted", replace(plan, course=course), 0),
    ]
    for said, other, seed in cases:
        assert differences(plan, 0, other, seed) == (said,)
        assert study_digest(other, seed) != study_digest(plan, 0)
    (said,) = differences(plan, 0, replace(plan, instruments=(instrument,)), 0)
    assert said.startswith("instruments[0].source: 'Soh & Demiris")


def test_an_added_field_is_a_difference(plan: ResolvedStudy):
    """A condition that one study lacks is told as nothing on its side."""
    conditions = {**plan.protocol.conditions, "extra": plan.protocol.conditions["limited"]}
    assert differences(plan, 0, _with(plan, conditions=conditions), 0) == (
        "protocol.conditions.extra: nothing there, a mapping wanted",)  # fmt: skip


def test_the_digest_does_not_depend_on_where_files_were(plan: ResolvedStudy, tmp_path):
    """The same study from a copied file in another folder has the same digest."""
    path = tmp_path / "copy.yaml"
    path.write_text(to_yaml(plan.protocol))
    assert study_digest(resolve_study(str(path)), 0) == study_digest(plan, 0)


def test_what_came_later_and_is_not_used_is_no_part_of_a_study():
    """Parameters, of groups' models too, and the laser: at their defaults they are left out."""
    plan = resolve_study("four-lap-balanced")
    model = {"use": "lad", "parameters": {"capacity": 200}}
    grouped = plan.protocol.model_copy(
        update={"groups": {name: Group.model_validate({"model": model}) for name in ("a", "b")}}
    )
    content = identity(replace(plan, protocol=grouped), 0)["protocol"]
    assert content["laser"] == {"rays": 180, "caster": "sweep"}
    for parameters in (
        content["model"]["parameters"],
        content["groups"]["a"]["model"]["parameters"],
    ):
        assert not set(parameters) & {"tune", "prior_help", "memory_laps", "constant_variance"}
    clipped = grouped.model_copy(update={"laser": LaserSettings(model_reach_m=2.0)})
    assert study_digest(replace(plan, protocol=clipped), 0) != study_digest(
        replace(plan, protocol=grouped), 0
    )
