"""Tables as text."""

import csv
import io

import pyarrow as pa
from hypothesis import given
from hypothesis import strategies as st

from analysis.export.delimited import Dialect, header_line, lines, zipped
from protocols.files.csv_text import harmless

TEXT = st.text(st.characters(exclude_categories=["Cs", "Cc"]) | st.sampled_from('",\n'), max_size=8)


@given(st.lists(st.tuples(st.none() | st.floats(allow_nan=False, allow_infinity=False), TEXT)))
def test_numbers_and_text_come_back_as_they_were(rows):
    """Python's own reader gets every digit and every character back, formulas as text."""
    numbers, texts = [row[0] for row in rows], [row[1] for row in rows]
    table = pa.table({"n": pa.array(numbers, pa.float64()), "t": pa.array(texts, pa.string())})
    text = (header_line(["n", "t"]) + lines(table)).decode()
    read = list(csv.reader(io.StringIO(text, newline="")))
    assert read[0] == ["n", "t"]
    assert [None if n == "" else float(n) for n, _ in read[1:]] == numbers
    assert [t for _, t in read[1:]] == [t if t is None else harmless(t) for t in texts]


def test_what_is_missing_is_not_what_is_empty():
    """A reader can tell a missing text from an empty one."""
    table = pa.table({"t": pa.array([None, ""], pa.string())})
    assert lines(table, Dialect(missing="NA")) == b'NA\n""\n'


def test_zipped_bytes_do_not_depend_on_time_or_name(tmp_path):
    """The same content gives the same file."""
    for name in ("a", "b"):
        with zipped(tmp_path / name) as stream:
            stream.write(b"x" * 1000)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
