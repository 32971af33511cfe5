"""Composite scores: SUS and NASA-TLX as their authors score them."""

from dataclasses import replace

import pandas as pd
import pytest

from analysis.composites import scores
from analysis.frames import study_frames
from protocols.instrument import Instrument
from protocols.load import load_instrument
from protocols.record.rows import response_fields


def frames_with(study, answers):
    """Return a study's frames with some answers in place of its own."""
    return replace(study_frames(study), surveys=pd.DataFrame(answers))


def rows(instrument, sheet, column):
    """Return one person's answers after the limited lap."""
    return [
        {"participant": "P0001", "condition": "limited", "instrument": instrument, "item": item,
         "response": None, "response_number": None, column: given}
        for item, given in sheet.items()
    ]  # fmt: skip


def test_sus_is_scored_as_brooke_does(study):
    """Odd items count x - 1, even ones 5 - x, the sum times 2.5."""
    sheet = dict(zip((f"S{i}" for i in range(1, 11)), (4, 2, 5, 1, 4, 3, 4, 2, 5, 1), strict=True))
    odd = sum(x - 1 for item, x in sheet.items() if int(item[1:]) % 2)
    even = sum(5 - x for item, x in sheet.items() if int(item[1:]) % 2 == 0)
    frames = frames_with(study, rows("sus", sheet, "response"))
    found = scores(frames, load_instrument("sus"), "usability", "limited")
    assert found.tolist() == [pytest.approx(2.5 * (odd + even))]


def test_raw_tlx_is_the_mean_of_its_six_lines(study):
    """0 to 100 as given; performance is not turned."""
    instrument = load_instrument("nasa-tlx")
    sheet = dict(zip((i.id for i in instrument.items), (10, 20, 30, 40, 50, 90), strict=True))
    frames = frames_with(study, rows("nasa-tlx", sheet, "response_number"))
    assert scores(frames, instrument, "workload", "limited").tolist() == [pytest.approx(40.0)]


def test_a_sheet_with_a_gap_has_no_score(study):
    """Nine of ten items are not a System Usability Score."""
    sheet = {f"S{i}": 3 for i in range(1, 11)} | {"S4": None}
    frames = frames_with(study, rows("sus", sheet, "response"))
    assert scores(frames, load_instrument("sus"), "usability", "limited").empty


def test_answers_off_the_steps_are_refused():
    """The line of NASA-TLX has 21 marks."""
    item = load_instrument("nasa-tlx").item("effort")
    assert response_fields(item, 35, 0) == {"response_number": 35.0}
    for given in (33, 105, -5):
        with pytest.raises(ValueError, match="not an answer"):
            response_fields(item, given, 0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"score": (100.0, 0.0)}, "not below"),
        ({"anchors": ("no",)}, "2 to 11"),
        ({"items": ({"id": "a", "text": "A?", "answer": "number"},), "score": (0.0, 1.0)},
         "no lowest or highest"),
    ],
)  # fmt: skip
def test_a_score_needs_one_range(change, message):
    """Unbounded, or upside down: what is wrong is said."""
    given = {"name": "x", "title": "X", "anchors": ("no", "yes"), "agreement_from": 2,
             "items": ({"id": "a", "text": "A?"},)} | change  # fmt: skip
    with pytest.raises(ValueError, match=message):
        Instrument(**given)
