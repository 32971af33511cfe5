"""YAML files as plain data that knows its lines, and every way a file can be no such thing."""

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocols.files.document import MAX_BYTES, Document, parse, spoken
from protocols.files.errors import InputError
from protocols.files.fault import Fault


def _said(content: bytes) -> str | None:
    """Return what reading complains of; None when it does not."""
    try:
        parse(content, "f.yaml")
    except InputError as error:
        return str(error)
    return None


def _refused(content: bytes) -> str:
    with pytest.raises(InputError) as caught:
        parse(content, "f.yaml")
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "data"),
    [
        ("a: 1", {"a": 1}),
        ("a: 0x1F\nb: 1_000\nc: 1e3\nd: -.5", {"a": 31, "b": 1000, "c": 1000.0, "d": -0.5}),
        ("a: yes\nb: no\nc: on", {"a": "yes", "b": "no", "c": "on"}),
        ("a: true\nb: False", {"a": True, "b": False}),
        ("c: null\nd: ~\ne:", {"c": None, "d": None, "e": None}),
        ("a: 2026-01-01\nb: '1'\nc: =", {"a": "2026-01-01", "b": "1", "c": "="}),
        ("a: &x [1, 2]\nb: *x", {"a": [1, 2], "b": [1, 2]}),
        ("1: a\ntrue: b", {"1": "a", "true": "b"}),
        ("\ufeffa: é", {"a": "é"}),
        ("%YAML 1.1\n---\na: yes\n", {"a": True}),
        ("- 1\n- [a, {b: c}]", [1, ["a", {"b": "c"}]]),
    ],
)  # fmt: skip
def test_reads_plain_values(text: str, data: object):
    """YAML 1.2 scalars, lists, mappings and anchors become plain Python values."""
    assert parse(text.encode(), "f.yaml").data == data


def test_every_value_knows_its_line():
    """A field's line is its key's, an entry's where it begins; an absent one has its parent's."""
    document = parse(b"# comment\na:\n  - b: 1\n    c:\n      [2,\n       3]\n", "f.yaml")
    lines = {
        ("a",): 2,
        ("a", 0): 3,
        ("a", 0, "b"): 3,
        ("a", 0, "c"): 4,
        ("a", 0, "c", 1): 6,
        ("a", 0, "missing"): 3,
        ("a", 7, "b"): 2,
        ("z",): 2,
    }
    assert {where: document.line(where) for where in lines} == lines


def test_faults_come_in_the_order_of_the_file():
    """The first fault of the message is the first one in the file."""
    document = Document("f.yaml", {}, {(): 1, ("a",): 2, ("b",): 3})
    error = document.error([Fault(("b", 1), "second"), Fault(("a",), "first")])
    assert error.faults == ("f.yaml:2: a: first", "f.yaml:3: b[1]: second")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "f.yaml:1: the file is empty"),
        (b"# only a comment\n", "f.yaml:1: the file is empty"),
        (b"a: [1\nb: 2\n", "f.yaml:2: not YAML: did not find expected ',' or ']'"),
        (b"a: 1\nb:\n\t- c\n", "f.yaml:3: not YAML: found character that cannot start any token"),
        (b"a: 1\nb: c: d\n", "f.yaml:2: not YAML: mapping values are not allowed in this context"),
        (b'a: "open\n', "f.yaml:1: not YAML: found unexpected end of stream"),
        (b"a: 1\n---\nb: 2\n", "f.yaml:2: not YAML: but found another document"),
        (b"%FOO\n", "f.yaml:1: not YAML:"),
        (b"a: 1\nb: 2\n\na: 3\n", "f.yaml:4: a: given twice; it is in line 1 already"),
        (b"l:\n  - {x: 1, x: 2}\n", "f.yaml:2: l[0].x: given twice"),
        (b"a: 1\nb: caf\xe9\n", "f.yaml:2: not UTF-8 text (byte 0xe9)"),
        (b"a: 1\nb: \x07\n", "f.yaml:2: character U+0007 is not allowed"),
        ("a: 1".encode("utf-16"), "f.yaml:1: not UTF-8 text"),
        (b"a: *nowhere\n", "f.yaml:1: not YAML: found undefined alias 'nowhere'"),
        (b"a: &a [*a]\n", "an anchor that contains itself is not allowed"),
        (b"x: &x {a: 1}\ny:\n  <<: *x\n", "f.yaml:3: y: '<<' is not supported"),
        (b"a: !!python/object:os.system x\n", "f.yaml:1: a: the tag"),
        (b"a: !!set {x}\n", "f.yaml:1: a: the tag"),
        (b"a: !mine 1\n", "f.yaml:1: a: the tag"),
        (b"? [1, 2]\n: 3\n", "f.yaml:1: a field's name must be plain text"),
        (b"a: " + b"9" * 5000, "is not a number"),
        (b'a: "\\ud800"\n', "not YAML: found invalid Unicode character escape code"),
        (b"[" * 100_000, "nested too deeply"),
        (b"- " * 60 + b"x", "f.yaml:1: nested too deeply; allowed: 50 levels"),
        (b"a: *" + b"x" * 1_900_000, "f.yaml:1: not YAML: found undefined alias 'xxx"),
        (b"a: !" + b"x" * 1_900_000, "f.yaml:1: a: the tag !xxx"),
        (b"? " + b"x" * 1_900_000 + b"\n: &a [*a]", "anchor that contains itself"),
        (b"#" * (MAX_BYTES + 1), "bytes; a file may have"),
    ],
)
def test_refuses_in_one_line(content: bytes, message: str):
    """Whatever is wrong with the file, one line says where and what."""
    refused = _refused(content)
    assert message in refused
    assert "\n" not in refused
    assert len(refused) < 300


SLOW_ONES = {
    "values": b"- 1\n" * 400_000,
    "a list in one line": b"[" + b"1," * 900_000 + b"]",
    "anchors": b"".join(b"- &a%d 1\n" % i for i in range(140_000)),
    "fields": b"".join(b"f%d: 1\n" % i for i in range(250_000)),
    "brackets": b"[" * MAX_BYTES,
    "dashes": b"- " * (MAX_BYTES // 2),
    "questions": b"? " * (MAX_BYTES // 2),
    "quotes": b'"' * MAX_BYTES,
    "numbers": b"a: " + b"1" * 1_900_000,
    "nested aliases": b"a0: &a0 [1]\n"
    + b"".join(b"a%d: &a%d [*a%d]\n" % (i, i, i - 1) for i in range(1, 5_000)),
}


@pytest.mark.parametrize("content", SLOW_ONES.values(), ids=SLOW_ONES)
def test_too_much_is_refused_as_soon_as_it_is_seen(content: bytes):
    """What is as large as a file may be, and means harm, is refused within seconds of work."""
    begun = time.process_time()
    assert len(_refused(content)) < 300
    assert time.process_time() - begun < 5.0  # on a busy machine; one second on a quiet one


def test_a_large_course_is_read_within_seconds():
    """Ten thousand points, as many as a centreline may have."""
    text = "".join(f"- [{i / 10}, {i * 0.37}]\n" for i in range(10_000))
    begun = time.process_time()
    assert len(parse(text.encode(), "f.yaml").data) == 10_000
    assert time.process_time() - begun < 5.0


def test_the_size_in_the_message_is_the_files():
    """Also where only the beginning was read."""
    with pytest.raises(InputError, match=r"f\.yaml: 50000000 bytes; a file may have 2000000"):
        parse(b"#" * 9, "f.yaml", 50_000_000)


def test_anchors_cannot_unfold_without_end():
    """A few lines of nested anchors that stand for billions of values are refused quickly."""
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 10)]
    assert _refused("\n".join(lines).encode()) == "f.yaml:5: expands to more than 100000 values"


@given(st.binary(max_size=200))
def test_any_bytes_are_data_or_one_line(content: bytes):
    """Bytes are either read or refused with an InputError that names the file; nothing else."""
    said = _said(content)
    assert said is None or (said.startswith("f.yaml:") and "\n" not in said)


@given(st.text(alphabet=" \n\t-:?[]{},&*!|>'\"%#@`<=~ab01.e\u2028\x85", max_size=60))
def test_any_text_of_yaml_marks_is_data_or_one_line(text: str):
    """The same for text made of what YAML gives a meaning to."""
    said = _said(text.encode())
    assert said is None or (said.startswith("f.yaml:") and "\n" not in said)


def test_locations_are_spoken_as_people_write_them():
    """Fields by dots, entries by brackets, the whole file by nothing."""
    assert spoken(("laps", 2, "survey", 0, "items", 1)) == "laps[2].survey[0].items[1]"
    assert spoken(()) == ""
