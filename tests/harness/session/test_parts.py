"""Who takes part: the person the seed draws, with the body the protocol gives them."""

from dataclasses import replace

import pytest

from harness.session.parts import draw_person, make_every_part, make_parts
from harness.session.study_run import StudyRun
from participants.human.driver import HumanDriver
from participants.impairments.tremor import Tremor
from participants.impairments.weakness import Weakness
from protocols.cohort import Cohort
from protocols.files.errors import InputError
from protocols.load import resolve_study


def run(**cohort):
    """Return the default study with another cohort."""
    study = resolve_study("four-lap")
    protocol = study.protocol.model_copy(update={"cohort": Cohort.model_validate(cohort)})
    return StudyRun(replace(study, protocol=protocol), 0)


def test_impairments_wrap_any_driver():
    """The person's own impairment is around the driver; without one the driver is as it is."""
    for impairments, kind in (
        ([], HumanDriver),
        ([{"use": "tremor"}], Tremor),
        ([{"use": "weakness", "severity": 0.2}], Weakness),
    ):
        study = run(impairments=impairments)
        driver = make_parts(study, 1).lap.driver
        assert type(getattr(driver, "impairment", driver)) is kind


def test_enlarging_a_study_leaves_everybody_their_body():
    """Participant n is the same person, impaired or not, in a study of any size."""
    small = run(participants=5, impairments=[{"use": "tremor", "share": 0.4}])
    large = run(participants=50, impairments=[{"use": "tremor", "share": 0.4}])
    people = [draw_person(large, n) for n in range(1, 51)]
    assert [draw_person(small, n) for n in range(1, 6)] == people[:5]
    assert 10 <= sum(person.impairment is not None for person in people) <= 30


def test_a_mistake_shows_before_anything_runs():
    """An impairment that the first participant does not have is tried, too."""
    rare = [{"use": "tremor", "share": 1e-9, "options": {"frequency": 5}}]
    with pytest.raises(InputError, match="option 'frequency' does not exist"):
        make_every_part(run(impairments=rare))
    with pytest.raises(InputError, match="no impairment is called 'nobody:knows'"):
        make_every_part(run(impairments=[{"use": "nobody:knows", "share": 0.0}]))


def test_traits_of_the_protocol_hold():
    """A protocol can say how a trait is distributed, and is told what is impossible."""
    alike = run(traits={"patience_s": {"median": 90, "spread": 0}})
    assert {round(draw_person(alike, n).traits.patience_s, 6) for n in range(1, 6)} == {90.0}
    one, other = (draw_person(p, 1).traits for p in (alike, run()))
    assert one.preferred_speed_m_s == other.preferred_speed_m_s
    for wrong in ("patience", "preferred_speed_m_s"):
        with pytest.raises(InputError, match=f"{wrong}: m"):
            make_every_part(run(traits={wrong: {"median": 90, "spread": 0}}))
