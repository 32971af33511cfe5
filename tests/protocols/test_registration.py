"""A registration: frozen, verified, amended, followed."""

import json
from dataclasses import replace

import pytest

from protocols.files.errors import InputError
from protocols.load import resolve_study
from protocols.order import in_words, laps_of
from protocols.registered_study import copy_registration, registered, registration_faults
from protocols.registration import REGISTRATION, read_registration, write_registration


@pytest.fixture
def study():
    """Return the balanced study."""
    return resolve_study("four-lap-balanced")


def other(study, **changes):
    """Return a study with another protocol."""
    return replace(study, protocol=study.protocol.model_copy(update=changes))


def test_it_freezes_the_plan_and_names_what_is_to_be_written(study, tmp_path):
    """Headings of both registries; the gaps are in the text and returned."""
    gaps = write_registration(study, tmp_path / "r")
    text = (tmp_path / "r" / "registration.md").read_text(encoding="utf-8")
    assert "## OSF Preregistration" in text
    assert "## AsPredicted" in text
    assert "OSF Preregistration: Sample size rationale" in gaps
    assert "OSF Preregistration: Margins of equivalence, and why" in gaps
    assert text.count("**To be written.**") == len(gaps)
    plan = json.loads((tmp_path / "r" / "plan.json").read_bytes())
    assert plan["participants"] == 12
    assert plan["study"]["protocol"]["orders"]["use"] == "williams"


def test_the_allocation_comes_from_the_digest(study, tmp_path):
    """Another plan, another allocation; the seed has no say in it."""
    write_registration(study, tmp_path / "r")
    registration = read_registration(tmp_path / "r")
    mine = registered(study, registration).protocol
    assert mine.registration == registration.digest
    orders = [in_words(laps_of(mine, n, 0)) for n in range(1, 13)]
    assert orders == [in_words(laps_of(mine, n, 5)) for n in range(1, 13)]
    assert len(set(orders)) == 4


@pytest.mark.parametrize("name", ["plan.json", "protocol.yaml"])
def test_a_changed_byte_is_found(study, tmp_path, name):
    """Whatever the byte is."""
    write_registration(study, tmp_path / "r")
    path = tmp_path / "r" / name
    path.write_bytes(path.read_bytes() + b" ")
    with pytest.raises(InputError, match="changed since it was registered"):
        read_registration(tmp_path / "r")


def test_another_plan_is_refused_in_one_line(study, tmp_path):
    """Another hold, more participants; fewer are a study that is not over."""
    write_registration(study, tmp_path / "r")
    registration = read_registration(tmp_path / "r")
    with pytest.raises(InputError, match="hold_s") as error:
        registered(other(study, hold_s=0.5), registration)
    assert "\n" not in str(error.value)
    more = study.protocol.cohort.model_copy(update={"participants": 13})
    with pytest.raises(InputError, match="stops at 12"):
        registered(other(study, cohort=more), registration)
    fewer = study.protocol.cohort.model_copy(update={"participants": 3})
    assert registered(other(study, cohort=fewer), registration).protocol.registration


def test_amendments_are_a_chain_with_reasons(study, tmp_path):
    """The last plan holds, the first one's digest allocates; a broken chain is refused."""
    folder = tmp_path / "r"
    write_registration(study, folder)
    first = read_registration(folder).digest
    more = other(study, cohort=study.protocol.cohort.model_copy(update={"participants": 16}))
    with pytest.raises(InputError, match="--amend with a reason"):
        write_registration(more, folder)
    write_registration(more, folder, "two blocks more")
    found = read_registration(folder)
    assert (found.digest, found.participants) == (first, 16)
    assert [head.reason for head in found.heads] == ["", "two blocks more"]
    with pytest.raises(InputError, match="nothing to amend"):
        write_registration(more, folder, "again")
    head = folder / "amendments" / "001" / "registration.yaml"
    head.write_text(head.read_text().replace(first, "ab" * 32))
    with pytest.raises(InputError, match="chain is broken"):
        read_registration(folder)


def test_a_study_directory_says_when_its_registration_is_gone_or_another(study, tmp_path):
    """Missing, another one, and right."""
    write_registration(study, tmp_path / "r")
    registration = read_registration(tmp_path / "r")
    mine = registered(study, registration)
    folder = tmp_path / "study"
    folder.mkdir()
    assert any("no registration" in fault for fault in registration_faults(folder, mine))
    copy_registration(registration, folder)
    assert not list(registration_faults(folder, mine))
    changed = other(mine, hold_s=0.4)
    assert any("hold_s" in fault for fault in registration_faults(folder, changed))
    plan = folder / REGISTRATION / "plan.json"
    plan.write_bytes(plan.read_bytes()[:-1])
    assert any("changed since" in fault for fault in registration_faults(folder, mine))


def test_a_folder_with_something_else_is_left_alone(study, tmp_path):
    """Nothing is written into a folder that holds other files."""
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match="holds something else"):
        write_registration(study, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]
