"""Nothing that people said of themselves, or others of them, leaves a study by default."""

import gzip
import re

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from analysis.export.registry import SHIPPED
from analysis.export.write import export_study
from protocols.record.elsewhere.rules import LAPS, PARTICIPANTS, STEPS, SURVEYS
from protocols.record.session import EVENTS_FILE
from protocols.record.tables import EVENT_SCHEMA

MARK = "Xq7 Jo Doe of 12 Elm St"
BORN = "born_19610304"
STAMP = 1_741_080_600.0
"""A time of day, s since 1970."""

LICENCE = "CC-BY-4.0"
FREE_OF_MARKS = {"participant", "condition", "instrument", "item", "kind"}
"""Columns of words that join tables, and the one that says who is living."""


def text_of(path):
    """Return everything in a file as text: compressed, packed or plain."""
    if path.suffix == ".gz":
        return gzip.decompress(path.read_bytes()).decode()
    if path.suffix == ".parquet":
        return f"{pq.read_schema(path).metadata} {pq.read_table(path).to_pylist()}"
    if path.suffix == ".mcap":
        reader = pytest.importorskip("mcap.reader")
        with path.open("rb") as stream:
            found = [(c.topic, m.data) for _, c, m in reader.make_reader(stream).iter_messages()]
        return repr(found)
    return path.read_text()


def everything(folder):
    """Return every name and every content of an export as text."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    assert files
    return "\n".join(f"{path.relative_to(folder)} {text_of(path)}" for path in files)


def marked(table, rules):
    """Return a table with the mark in every column of words, and with columns of nobody's."""
    for name, kind in ((c.name, c.type) for c in rules.columns):
        if pa.types.is_string(kind) and name not in FREE_OF_MARKS:
            at, values = table.schema.get_field_index(name), pa.array([MARK] * len(table))
            table = table.set_column(at, name, values)
    return table.append_column("email", pa.array([f"{MARK}@example.org"] * len(table)))


@pytest.fixture
def theirs(make_study, consented_protocol):
    """Return a study that another program recorded of living people, with the mark everywhere."""
    folder = make_study(consented_protocol(sharing=True), participants=2, living=True).folder
    head = (folder / "study.yaml").read_text()
    head = head.replace("origin: live", "origin: elsewhere")
    (folder / "study.yaml").write_text(head)
    ids = {"P0001": f"{MARK} 1", "P0002": f"{MARK} 2"}
    for name, rules in (("participants", PARTICIPANTS), ("laps", LAPS), ("surveys", SURVEYS)):
        table = marked(pq.read_table(folder / f"{name}.parquet"), rules)
        at = table.schema.get_field_index("participant")
        renamed = pa.array([ids[who] for who in table["participant"].to_pylist()])
        table = table.set_column(at, "participant", renamed)
        if name == "participants":
            at = table.schema.get_field_index("traits")
            said = pa.array([[(BORN, 1.0), (MARK, 2.0)]] * len(table), table.schema.field(at).type)
            table = table.set_column(at, "traits", said)
        pq.write_table(table, folder / f"{name}.parquet")
    for who, renamed in ids.items():
        (folder / "sessions" / who).rename(folder / "sessions" / renamed)
    for path in folder.rglob("steps-*.parquet"):
        table = marked(pq.read_table(path), STEPS)
        at = table.schema.get_field_index("t_s")
        stamps = pa.array([STAMP + t for t in table["t_s"].to_pylist()])
        pq.write_table(table.set_column(at, "t_s", stamps), path)
    return folder


@pytest.mark.parametrize("name", SHIPPED)
def test_nothing_personal_of_another_programs_record_goes_out(theirs, name, tmp_path):
    """Not in words, ids, traits, further columns, file names or calendar times."""
    export_study(theirs, name, tmp_path / "out", licence=LICENCE)
    said = everything(tmp_path / "out")
    for secret in (MARK, MARK.replace(" ", ""), BORN):
        assert secret not in said, secret
    assert not re.search(rf"(?<![\d.]){str(int(STAMP))[:7]}\d{{3}}", said)


def test_what_is_included_is_there(theirs, tmp_path):
    """The mark is where it was put in: what the other test looks for can be found."""
    include = frozenset({"words", "ids", "ages"})
    export_study(theirs, "frictionless", tmp_path / "out", licence=LICENCE, include=include)
    people = (tmp_path / "out" / "participants.csv").read_text()
    assert f"{MARK} 1" in people
    assert people.count(MARK) > 4
    assert BORN not in people
    assert f"{MARK} 1" in everything(tmp_path / "out")
    assert MARK in (tmp_path / "out" / "laps.csv").read_text()


@pytest.mark.parametrize("name", SHIPPED)
def test_nothing_personal_of_our_own_record_goes_out(
    make_study, consented_protocol, name, tmp_path
):
    """Neither reasons for leaving, nor browsers, notes and times in the table of events."""
    protocol = consented_protocol(sharing=True)
    code = f"live: {{completion: {{code: '{MARK}'}}}}\n"
    protocol.write_text(protocol.read_text() + code)
    study = make_study(protocol, participants=2, living=True, withdrew={1: 2}, words={1: MARK})
    row = {"participant": "P0001", "lap": None, "step": None, "utc": "2026-03-04T09:30:00Z",
           "actor": "program", "event": "browser", "note": f"Mozilla/5.0 {MARK}"}  # fmt: skip
    events = study.folder / "sessions" / "P0001" / EVENTS_FILE
    pq.write_table(pa.Table.from_pylist([row], EVENT_SCHEMA), events)
    export_study(study.folder, name, tmp_path / "out", licence=LICENCE)
    said = everything(tmp_path / "out")
    for secret in (MARK, "Mozilla", "2026-03-04", study.header.platform):
        assert secret not in said, secret
