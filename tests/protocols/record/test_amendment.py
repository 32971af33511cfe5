"""An amendment of the registration in a study under way."""

from dataclasses import replace

import pytest

from protocols.load import resolve_study
from protocols.record.amendment import amend_study, first_digest, plan_number
from protocols.record.header import read_header
from protocols.record.rows import ParticipantRow
from protocols.record.session import SessionRecord, encode
from protocols.record.store import (
    finished_sessions,
    open_folder,
    refuse_another_study,
    write_session,
)
from protocols.registered_study import (
    copy_registration,
    plan_study,
    registered,
    registration_faults,
)
from protocols.registration import read_registration, write_registration


def session(who, digest):
    """Return the files of a session in which nothing was driven."""
    person = ParticipantRow(participant=who, kind="synthetic", driver="human", completed=False,
                            laps_planned=5, laps_driven=0, excluded=False, traits={})  # fmt: skip
    return encode(SessionRecord(person, (), (), None), digest)


@pytest.fixture
def under_way(tmp_path):
    """Return the folders of a study with one session and of its registration, and the study."""
    study, plan, folder = resolve_study("four-lap-balanced"), tmp_path / "plan", tmp_path / "study"
    write_registration(study, plan)
    first = read_registration(plan)
    header = open_folder(folder, registered(study, first), 3)
    copy_registration(first, folder)
    write_session(folder, "P0001", session("P0001", header.digest))
    return folder, plan, study


def amended(study, plan):
    """Amend the plan, and return the study as amended, following it, with the chain."""
    changed = replace(study, protocol=study.protocol.model_copy(update={"hold_s": 0.5}))
    write_registration(changed, plan, "commands came late")
    chain = read_registration(plan)
    return registered(changed, chain), chain


def test_sessions_before_stay_and_are_named(under_way):
    """The head has the new plan and the digest of the beginning; the next session is after it."""
    folder, plan, study = under_way
    digest = read_header(folder).digest
    changed, chain = amended(study, plan)
    assert amend_study(folder, changed, 3, chain) == ("P0001",)
    header = read_header(folder)
    assert refuse_another_study(folder, changed, 3) == header
    assert header.digest == digest == first_digest(header, chain)
    assert finished_sessions(folder, header.digest) == ("P0001",)
    assert (plan_number(header, "P0001"), plan_number(header, "P0002")) == (0, 1)
    assert [plan_study(chain, n).protocol.hold_s for n in (0, 1)] == [0.3, 0.5]
    assert not list(registration_faults(folder, header.study))
    assert amend_study(folder, changed, 3, chain) == ()
    assert read_header(folder) == header


def test_what_does_not_follow_the_registration_is_left_alone(under_way, tmp_path):
    """Another seed, another registration, no directory: nothing is written."""
    folder, plan, study = under_way
    changed, chain = amended(study, plan)
    before = (folder / "study.yaml").read_bytes()
    assert amend_study(folder, changed, 4, chain) == ()
    write_registration(changed, tmp_path / "other")
    other = read_registration(tmp_path / "other")
    assert amend_study(folder, registered(changed, other), 3, other) == ()
    assert amend_study(tmp_path / "nothing", changed, 3, chain) == ()
    assert (folder / "study.yaml").read_bytes() == before
    assert not (tmp_path / "nothing").exists()
