"""Questionnaire exports become answers."""

import csv
import re

import numpy as np
import pytest

from protocols.files.errors import InputError
from protocols.importing.answers.guess import guess_mapping
from protocols.importing.answers.mapping import AnswersMapping
from protocols.importing.answers.write import import_answers
from protocols.importing.mapping_file import read_mapping
from protocols.record.reader import open_study
from protocols.shipped import shipped_text

BASE = """\
schema: 1
participant: {{column: who}}
instrument: driving-assistance
wide: {{columns: "L{{lap}}.{{item}}"}}
{more}
"""


@pytest.fixture
def bring_in(elsewhere, tmp_path):
    """Return the function that imports a table of text with a mapping into a study of two."""

    def run(text, more="", mapping=None, people=("P0001", "P0002"), encoding="utf-8"):
        study = elsewhere(*people)
        (tmp_path / "f.csv").write_bytes(text.encode(encoding))
        (tmp_path / "map.yaml").write_text(mapping or BASE.format(more=more))
        done = import_answers(tmp_path / "f.csv", tmp_path / "map.yaml", study.folder)
        return done, open_study(study.folder)

    return run


def given(study):
    """Return a study's answers by participant, lap and item."""
    rows = study.surveys.to_pylist()
    return {(r["participant"], r["lap"], r["item"]): r["response"] for r in rows}


def test_answers_exported_wide_come_back_equal(elsewhere, tmp_path):
    """Every answer of a study, labels and reversed order included, is what it was."""
    study = elsewhere("P0001", "P0002", "P0003")
    instrument = study.instruments[0]
    rng = np.random.default_rng(5)
    wanted = {}
    for row in study.laps.to_pylist():
        for survey in study.protocol.laps[row["lap"]].survey:
            for item in survey.items:
                answer = None if rng.random() < 0.1 else int(rng.integers(1, 6))
                wanted[row["participant"], row["lap"], item] = answer
    columns = sorted({key[1:] for key in wanted})
    with (tmp_path / "wide.csv").open("w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(["ID", *(f"Lap{lap + 1}_{item}" for lap, item in columns)])
        for i, who in enumerate(("P0001", "P0002", "P0003")):
            cells = []
            for lap, item in columns:
                answer = wanted.get((who, lap, item))
                shown = None if answer is None else 6 - answer if item == "Q3" else answer
                cells.append("" if shown is None else instrument.anchors[shown - 1])
            writer.writerow([f"{i:04d}", *cells])
    (tmp_path / "map.yaml").write_text(
        'schema: 1\nparticipant: {column: ID, ids: {"0000": P0001, "0001": P0002, "0002": P0003}}\n'
        'instrument: driving-assistance\nwide: {columns: "Lap{lap}_{item}"}\nfirst_lap: 1\n'
        "labels: anchors\nreversed: [Q3]\n"
    )
    done = import_answers(tmp_path / "wide.csv", tmp_path / "map.yaml", study.folder)
    assert done.unmatched == ()
    assert given(open_study(study.folder)) == wanted


def test_a_long_file_gives_the_same_as_a_wide_one(bring_in):
    """A row per answer."""
    mapping = (
        "schema: 1\nparticipant: {column: who}\ninstrument: driving-assistance\n"
        "long: {item: question, answer: value, lap: round}\n"
    )
    text = "who,round,question,value\nP0001,1,Q1,4\nP0001,1,Q2,5\nP0002,2,Q1,1\n"
    done, study = bring_in(text, mapping=mapping)
    assert done.answered == 3
    assert given(study)["P0002", 2, "Q1"] == 1


def test_questions_that_the_file_does_not_answer_are_on_record(bring_in):
    """Asked by the protocol, missing in the file: a row without an answer."""
    done, study = bring_in("who,L1.Q1\nP0001,4\n")
    assert done.answered == 1
    assert given(study)["P0001", 1, "Q2"] is None
    assert "P0002 is not in the file" in done.unmatched


def test_a_second_file_leaves_the_answers_of_others(bring_in, tmp_path):
    """Who is not in it keeps what was brought in before; who is gets the new answers."""
    _, study = bring_in("who,L1.Q1\nP0001,4\nP0002,2\n")
    (tmp_path / "more.csv").write_text("who,L1.Q1\nP0002,3\n")
    import_answers(tmp_path / "more.csv", tmp_path / "map.yaml", study.folder)
    after = given(open_study(study.folder))
    assert after.keys() == given(study).keys()
    assert (after["P0001", 1, "Q1"], after["P0002", 1, "Q1"]) == (4, 3)


def test_what_belongs_to_nothing_is_listed(bring_in):
    """Columns, people and laps that the study does not have."""
    done, _ = bring_in("who,when,L1.Q1,L1.Q99,L7.Q1\nP0001,1,4,4,4\nP0002,,3,,\nP0009,1,4,4,4\n")
    assert set(done.unmatched) == {
        "column 'when' is no item of driving-assistance",
        "column 'L1.Q99' is no item of driving-assistance",
        "P0009 is not in the study",
        "P0001 did not drive lap 7",
        "P0002 did not drive lap 7",
    }


def test_qualtrics_extra_rows_previews_and_semicolons(bring_in):
    """Two rows below the names are passed over, and rows that the mapping drops."""
    text = (
        "who;Status;L1.Q1\nWording;Status;It was easy\n{ImportId};x;y\nP0001;ok;2\nP0002;test;5\n"
    )
    more = 'skip_rows: 2\nseparator: ";"\ndrop: [{column: Status, values: [test]}]'
    done, study = bring_in(text, more)
    assert given(study)["P0001", 1, "Q1"] == 2
    assert given(study)["P0002", 1, "Q1"] is None
    assert "1 rows were dropped, as the mapping says" in done.unmatched


@pytest.mark.parametrize(
    ("text", "more", "message"),
    [
        (
            "who,L1.Q1\nP0001,Maybe\n",
            "",
            "f.csv:2: column 'L1.Q1': 'Maybe' is no answer to Q1; all",
        ),
        ("who,L1.Q1\nP0001,6\n", "", "f.csv:2: column 'L1.Q1': '6' is no answer to Q1"),
        ("who,L1.Q1\nP0001,4\nP0001,3\n", "", "f.csv:3: column 'L1.Q1': P0001 answered Q1 after l"),
        ("whom,L1.Q1\nP0001,4\n", "", "f.csv:1: no column 'who'; allowed: whom, L1.Q1 (did you m"),
        ("who,Q1\nP0001,4\n", "", "no column is like 'L{lap}.{item}'"),
        ("who;L1.Q1\nP0001;4\n", "", "f.csv:1: 1 column; is the separator ',' right?"),
        ("who,L1.Q1\nP0001,4,5\n", "", "f.csv:2: 3 values; allowed: 2"),
        ("who,L1.Q1\nP0001,4\n", "reversed: [Q77]", "map.yaml:5: reversed: 'Q77' is no item"),
        ("who,L1.Q1\nP0001,nan\n", "", "f.csv:2: column 'L1.Q1': 'nan' is no answer to Q1"),
        ("who;L1.Q1\nP0001;4.0\n", "decimal: ','\nseparator: ;", "'4.0' is no answer to Q1"),
        ("who,L1.Q1\nP0009,4\n", "", "f.csv: nobody in it is in the study; allowed: P0001, P0002"),
        ("who,L1.Q1\n", "", "f.csv: nobody in it is in the study"),
        ("who,L1.Q1,L1.Q1\nP0001,4,4\n", "", "column 'L1.Q1' is there twice"),
    ],
)
def test_bad_files_are_one_line(text, more, message, bring_in, tmp_path):
    """The line has the place and what is allowed; nothing is written."""
    with pytest.raises(InputError, match=re.escape(message)):
        bring_in(text, more)
    assert not (tmp_path / "elsewhere" / "surveys.parquet").exists()


def test_another_encoding_is_named(bring_in):
    """The line, and the encodings that can be given."""
    with pytest.raises(InputError, match=r"f\.csv:2: not utf-8 text; allowed: another encoding"):
        bring_in("who,L1.Q1\nJosé,4\n", encoding="cp1252")


def test_text_that_looks_like_nothing_is_text(bring_in):
    """'None' and 'NA' are no missing answers unless the mapping says so."""
    with pytest.raises(InputError, match="'NA' is no answer"):
        bring_in("who,L1.Q1\nP0001,NA\n")


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ("long: {item: a, answer: b, lap: 1}", r"map\.yaml:1: give either wide or long"),
        ("firstlap: 1", r"map\.yaml:5: firstlap: .*did you mean 'first_lap'"),
        ("labels: {Yes: 5, yes: 4}", r"map\.yaml:1: labels: 'yes' is there twice"),
        ("doubled: first", r"map\.yaml:5: doubled: "),
    ],
)
def test_a_mapping_is_checked_with_its_lines(more, message, bring_in):
    """Unknown fields and values, and parts that contradict one another."""
    with pytest.raises(InputError, match=message):
        bring_in("who,L1.Q1\nP0001,4\n", more)


def test_a_study_of_ours_keeps_its_own_answers(tmp_path, bring_in):
    """What was asked during the visit is not replaced."""
    _, study = bring_in("who,L1.Q1\nP0001,4\n")
    head = (study.folder / "study.yaml").read_text()
    changed = head.replace("origin: elsewhere", "origin: live").replace("seed: null", "seed: 1")
    (study.folder / "study.yaml").write_text(changed)
    with pytest.raises(InputError, match="recorded its answers itself"):
        import_answers(tmp_path / "f.csv", tmp_path / "map.yaml", study.folder)


def test_a_guess_is_a_mapping_that_works(elsewhere, tmp_path):
    """Drafted from a Qualtrics-like file; only the labels' points have to be filled in."""
    study = elsewhere("P0001", "P0002")
    text = (
        "ResponseId;Participant;R1_Q1;R1_Q2;R2_Q1\nw;w;w;w;w\n"
        '{"ImportId":"a"};x;x;x;x\nr1;P0001;Agree;4;Agree\nr2;P0002;Agree;2;Disagree\n'
    )
    (tmp_path / "f.csv").write_bytes(b"\xef\xbb\xbf" + text.encode())
    draft = guess_mapping(tmp_path / "f.csv")
    filled = draft.replace('"Agree": null', '"Agree": 4').replace('"Disagree": null', "Disagree: 2")
    assert "first_lap: 1" in draft
    (tmp_path / "m.yaml").write_text(filled)
    done = import_answers(tmp_path / "f.csv", tmp_path / "m.yaml", study.folder)
    assert done.answered == 6
    assert given(open_study(study.folder))["P0002", 1, "Q1"] == 2


def test_the_shipped_example_is_a_mapping(tmp_path):
    """It can be copied as it is."""
    (tmp_path / "m.yaml").write_text(shipped_text("answers-mapping"))
    mapping, _ = read_mapping(tmp_path / "m.yaml", AnswersMapping)
    assert mapping.wide is not None
