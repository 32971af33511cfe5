"""What is applied is written down before it acts, and can be read whatever was cut off."""

import contextlib
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness.session.clock import Timing
from harness.session.journal import FileJournal, tick_entry
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from protocols.files.errors import InputError
from protocols.load import resolve_study
from protocols.record.journal import entry_line, journal_header, read_journal

STUDY = resolve_study("four-lap")
HEADER = journal_header(STUDY, 0, "P0001")
HELP = Assistance(helping=True, command=Command(0.2, -0.5))


def write_some(path):
    """Write a journal with an entry of every kind."""
    journal = FileJournal(path, HEADER)
    journal.stage(0, "lap", 0)
    journal.tick(Command(0.1, 0.2), NO_ASSISTANCE, None)
    journal.tick(None, HELP, Timing(0.001, 0.0, 0.0))
    journal.broken_off("withdrew", 'too "slow"\n')
    journal.page("demographics", {"age_years": 31, "gender": None})
    journal.answers([4, None, 37.5, "quick, and quiet \u2028 ü"])
    journal.close()


def test_entries_read_back_as_they_were(tmp_path):
    """Numbers, gaps, line breaks and other people's alphabets survive."""
    path = tmp_path / "P0001.jsonl"
    write_some(path)
    journal = read_journal(path)
    assert journal.header == HEADER
    assert journal.entries == (
        {"stage": [0, "lap", 0]},
        {"tick": {"u": [0.1, 0.2], "d": [0]}},
        {"tick": {"d": [1, 0.2, -0.5], "t": [0.001, 0.0, 0.0]}},
        {"end": ["withdrew", 'too "slow"\n']},
        {"page": ["demographics", {"age_years": 31, "gender": None}]},
        {"answers": [4, None, 37.5, "quick, and quiet \u2028 ü"]},
    )


@given(st.floats(allow_nan=False, allow_infinity=False), st.floats(-1e-300, 1e-300))
def test_numbers_are_exact(v, w):
    """A command read from a journal is the command that was applied, to the last bit."""
    entry = tick_entry(Command(v, w), None, None)
    assert json.loads(entry_line(entry)) == {"u": [v, w]}


def test_a_cut_at_any_byte_loses_the_torn_line_and_no_more(tmp_path):
    """Whatever byte a killed process came to, every whole line before it is there."""
    path, cut = tmp_path / "P0001.jsonl", tmp_path / "cut.jsonl"
    write_some(path)
    content, entries = path.read_bytes(), read_journal(path).entries
    first = content.index(b"\n") + 1
    for length in range(first, len(content)):
        cut.write_bytes(content[:length])
        whole = content[:length].count(b"\n") - 1
        assert read_journal(cut).entries == entries[:whole]
    for length in (0, 1, first - 1):
        cut.write_bytes(content[:length])
        with pytest.raises(InputError, match="holds no whole line"):
            read_journal(cut)


def test_a_journal_goes_on_where_it_was_cut(tmp_path):
    """The torn line is dropped, what is said again is checked, and the rest is appended."""
    path, whole = tmp_path / "P0001.jsonl", tmp_path / "whole.jsonl"
    write_some(whole)
    path.write_bytes(whole.read_bytes()[:-3])
    write_some(path)
    assert path.read_bytes() == whole.read_bytes()


def test_a_session_that_differs_from_its_journal_is_refused(tmp_path):
    """Replaying something else is said with both lines, and nothing is appended."""
    path = tmp_path / "P0001.jsonl"
    write_some(path)
    before = path.read_bytes()
    journal = FileJournal(path, HEADER)
    journal.stage(0, "lap", 0)
    with (
        contextlib.closing(journal),
        pytest.raises(InputError, match=r'differs.*"u":\[0.1,0.2\].*"u":\[0.1,0.3\]'),
    ):
        journal.tick(Command(0.1, 0.3), NO_ASSISTANCE, None)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("header", "said"),
    [
        (journal_header(STUDY, 1, "P0001"), "seed: 0 there, 1 wanted"),
        (journal_header(STUDY, 0, "P0002"), "participant: P0001 there, P0002 wanted"),
        (
            journal_header(resolve_study("rd-laps"), 0, "P0001"),
            "protocol.name: 'four-lap' there, 'rd-laps' wanted",
        ),
    ],
)
def test_another_sessions_journal_is_refused(tmp_path, header, said):
    """The difference is named, and the file stays as it is."""
    path = tmp_path / "P0001.jsonl"
    write_some(path)
    before = path.read_bytes()
    with pytest.raises(InputError, match="cannot be replayed") as error:
        FileJournal(path, header)
    assert said in str(error.value)
    assert path.read_bytes() == before


def test_other_package_versions_are_refused(tmp_path, monkeypatch):
    """Another physics engine would not give the same bytes."""
    path = tmp_path / "P0001.jsonl"
    write_some(path)
    versions = {**HEADER.versions, "numpy": "0.1"}
    monkeypatch.setattr("protocols.record.journal.package_versions", lambda: versions)
    with pytest.raises(InputError, match=r"numpy: version .* there, 0\.1 here"):
        FileJournal(path, journal_header(STUDY, 0, "P0001"))


@pytest.mark.parametrize(
    ("line", "said"),
    [(b"[1]\n", ":2: not a line"), (b"\x00\n", ":2: not a line"), (b"{\n", ":2: not a line")],
)
def test_damage_inside_is_named_by_its_line(tmp_path, line, said):
    """Only a last line may be cut short; damage before it is no accident to pass over."""
    path = tmp_path / "P0001.jsonl"
    path.write_bytes(entry_line(HEADER.line()) + line + entry_line({"stage": [0, "lap", 0]}))
    with pytest.raises(InputError, match=said):
        read_journal(path)


@pytest.mark.parametrize("first", [{"journal": 9}, {"journal": 1}, {"schema": 1}])
def test_another_kind_of_file_is_refused(tmp_path, first):
    """A first line of another version, or of something else, is named."""
    path = tmp_path / "P0001.jsonl"
    path.write_bytes(entry_line(first))
    with pytest.raises(InputError, match=":1: "):
        read_journal(path)
