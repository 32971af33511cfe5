"""Whose data may be handed on, and what is left out of them."""

from dataclasses import replace
from types import SimpleNamespace

import pandas as pd
import pyarrow as pa
import pytest

from analysis.export.privacy import age_bands, unique_people
from analysis.export.sharing import may_be_shared
from analysis.export.write import export_study
from protocols.files.errors import InputError
from protocols.record.header import AmendedStudy

WORDS = "I feel sick, says Jo"


def everything(folder):
    """Return every byte of an export."""
    return b"".join(path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file())


def test_free_text_is_left_out_unless_asked_for(make_study, tmp_path):
    """What a person said goes out with --include words only."""
    study = make_study(withdrew={1: 2}, words={1: WORDS})
    export_study(study.folder, "frictionless", tmp_path / "without")
    export_study(study.folder, "frictionless", tmp_path / "with", include=frozenset({"words"}))
    assert WORDS.encode() not in everything(tmp_path / "without")
    assert WORDS in (tmp_path / "with" / "laps.csv").read_text()


def test_ages_are_banded_unless_asked_for(study, exported, tmp_path):
    """An age is given in tens of years; exactly with --include ages."""
    banded = pd.read_csv(exported("frictionless") / "participants.csv")
    ages = study.participants.to_pandas()["age_years"]
    assert "age_years" not in banded
    assert banded["age_band"].tolist() == [f"{a // 10 * 10}-{a // 10 * 10 + 9}" for a in ages]
    export_study(study.folder, "frictionless", tmp_path / "ages", include=frozenset({"ages"}))
    exact = pd.read_csv(tmp_path / "ages" / "participants.csv")
    assert exact["age_years"].tolist() == ages.tolist()


def test_the_oldest_are_one_band():
    """Nobody's age above 89 can be told."""
    assert age_bands(pa.chunked_array([[89, 90, 104]])).to_pylist() == ["80-89", "90+", "90+"]


def test_people_who_are_alone_with_their_traits_are_counted():
    """Two equal people hide each other; the third stands out."""
    people = pa.table({"age_band": ["20-29"] * 3, "gender": ["female", "female", "male"]})
    assert unique_people(people) == 1


def test_living_people_need_a_consent_that_allows_it(make_study, consented_protocol, tmp_path):
    """Without one, nothing is written."""
    study = make_study(consented_protocol(sharing=False), living=True)
    with pytest.raises(InputError, match="their consent must allow sharing"):
        export_study(study.folder, "r", tmp_path / "out", licence="CC-BY-4.0")
    assert not (tmp_path / "out").exists()


def test_living_people_need_a_licence(make_study, consented_protocol, tmp_path):
    """There is no default for other people's data."""
    study = make_study(consented_protocol(sharing=True), living=True)
    with pytest.raises(InputError, match="--licence: missing; data of living people need one"):
        export_study(study.folder, "r", tmp_path / "out")
    export_study(study.folder, "r", tmp_path / "out", licence="CC-BY-4.0")
    assert "CC-BY-4.0" in (tmp_path / "out" / "LICENSE").read_text()


def test_who_did_not_consent_is_left_out(make_study, consented_protocol, tmp_path):
    """Their rows and their steps are not there, and the README says how many."""
    study = make_study(consented_protocol(sharing=True), living=True)
    people = study.participants
    consents = pa.array([name != "P0002" for name in people["participant"].to_pylist()])
    place = people.schema.get_field_index("consented")
    changed = people.set_column(place, people.schema.field(place), consents)
    pa.parquet.write_table(changed, study.folder / "participants.parquet")
    export_study(study.folder, "frictionless", tmp_path / "out", licence="CC-BY-4.0")
    for name in ("participants.csv", "laps.csv", "surveys.csv", "steps.csv.gz"):
        there = set(pd.read_csv(tmp_path / "out" / name)["participant"])
        assert there == {"P0001", "P0003", "P0004"}, name
    assert "1 participants whose consent" in (tmp_path / "out" / "README.md").read_text()


def test_who_agreed_to_a_text_without_sharing_is_left_out(
    make_study, consented_protocol, monkeypatch
):
    """An amendment that allows sharing says nothing about those who took part before it."""
    study = make_study(consented_protocol(sharing=True), participants=3, living=True)
    later = study.protocol
    consent = later.consent.model_copy(update={"sharing": False})
    first = later.model_copy(update={"consent": consent})
    chain = SimpleNamespace(protocols=(first, later))
    monkeypatch.setattr("analysis.export.sharing.read_registration", lambda _: chain)
    amended = (AmendedStudy(number=1, sessions=("P0001",)),)
    header = study.header.model_copy(update={"amended": amended})
    shared = may_be_shared(replace(study, header=header), living=True)
    assert shared.to_pylist() == [False, True, True]


def test_a_licence_of_ones_own_goes_with_the_copy(study, tmp_path):
    """A text file is a licence too."""
    (tmp_path / "ours.txt").write_text("Ask us first.")
    export_study(study.folder, "r", tmp_path / "out", licence=str(tmp_path / "ours.txt"))
    assert (tmp_path / "out" / "LICENSE").read_text() == "Ask us first."


def test_an_unknown_licence_is_refused(study, tmp_path):
    """One line with what is allowed."""
    with pytest.raises(InputError, match=r"--licence: 'CC-BY-4'; .*did you mean 'CC-BY-4.0'"):
        export_study(study.folder, "r", tmp_path / "out", licence="CC-BY-4")


def test_nothing_about_the_computer_goes_out(exported, study):
    """Neither the platform nor calendar times."""
    platform = study.header.platform
    assert platform
    assert platform.encode() not in everything(exported("frictionless"))
