"""Laps and answers are matched by what they say of themselves."""

import pyarrow as pa
import pytest

from protocols.files.errors import InputError
from protocols.laps import PlannedLap
from protocols.record.elsewhere.numbering import (
    contradictions,
    first_number,
    practice,
    renumbered_answers,
    with_known_conditions,
)

PLAN = (
    PlannedLap(condition="b", practice=True),
    PlannedLap(condition="a"),
    PlannedLap(condition="b"),
)


def laps(*rows, said=None):
    """Return a lap table of (participant, lap, condition)."""
    columns = list(zip(*rows, strict=True))
    return pa.table(
        {"participant": columns[0], "lap": pa.array(columns[1], pa.int16()),
         "condition": columns[2], "practice": pa.array(said or [None] * len(rows), pa.bool_())}
    )  # fmt: skip


@pytest.mark.parametrize("first", [0, 1, 7])
def test_whole_sessions_are_matched_whatever_their_numbers(first):
    """Two laps of b: the first is the practice one, in any numbering."""
    found = practice(laps(*(("P", first + n, c) for n, c in enumerate("bab"))), PLAN, "laps")
    assert found.column == (True, False, False)
    assert "1 laps of b are practice by the plan" in found.remarks[0]


@pytest.mark.parametrize("first", [0, 1])
def test_who_left_early_is_matched_by_the_numbers_that_agree(first):
    """One lap of b and no more: the plan says which, for the numbers agree with it."""
    found = practice(laps(("P", first, "b"), ("P", first + 1, "a"), ("Q", first, "b"),
                          ("Q", first + 1, "a"), ("Q", first + 2, "b")), PLAN, "laps")  # fmt: skip
    assert found.column == (True, False, True, False, False)


def test_what_nothing_tells_is_refused():
    """One lap of b at a place where the plan has none: it may be either."""
    with pytest.raises(InputError, match="nothing tells which laps of b P drove for practice: 1"):
        practice(laps(("P", 4, "b"), ("P", 5, "a")), PLAN, "laps")


def test_what_a_lap_says_of_itself_counts():
    """A recorded practice is not overruled by the plan; a missing one beside it is filled."""
    rows = [("P", n, c) for n, c in enumerate("bab")]
    assert practice(laps(*rows, said=[False, True, True]), PLAN, "laps")[0] == (False, True, True)
    assert practice(laps(*rows, said=[None, False, False]), PLAN, "laps")[0] == (
        True, False, False)  # fmt: skip


def test_another_order_is_no_contradiction():
    """Who drove a after b, twice: practice is still the first b."""
    found = practice(laps(("P", 0, "b"), ("P", 1, "b"), ("P", 2, "a")), PLAN, "laps")
    assert found.column == (True, False, False)


@pytest.mark.parametrize(("numbers", "first"), [((0, 1, 2), 0), ((1, 2, 3), 1), ((5, 6, 7), None)])
def test_from_which_number_laps_are_counted(numbers, first):
    """The number from which they have the planned conditions."""
    rows = [("P", n, c) for n, c in zip(numbers, "bab", strict=True)]
    assert first_number(laps(*rows), PLAN) == first


@pytest.mark.parametrize("shift", [-1, 0, 1])
def test_answers_find_their_laps(shift):
    """Counted from another number, answers are brought to the laps of their conditions."""
    driven = laps(*(("P", 1 + n, c) for n, c in enumerate("bab")))
    answers = laps(("P", 2 + shift, "a"), ("P", 3 + shift, "b"))
    mended, said = renumbered_answers(answers, driven)
    assert mended["lap"].to_pylist() == [2, 3]
    assert bool(said) == bool(shift)


def test_answers_that_contradict_in_any_numbering_are_counted():
    """They are not moved, and it is known how many they are."""
    driven = laps(("P", 0, "b"), ("P", 1, "a"), ("P", 2, "b"))
    answers = laps(("P", 0, "a"), ("P", 1, "a"))
    assert renumbered_answers(answers, driven) == (answers, "")
    assert contradictions(answers, driven) == 1


def test_conditions_that_read_alike_are_one_unless_the_plan_has_two():
    """Letter case, blanks, dashes; but never a choice between two."""
    table = laps(("P", 0, "Human assisted"), ("P", 1, "B"))
    mended, said = with_known_conditions(table, ["human-assisted", "b"])
    assert mended["condition"].to_pylist() == ["human-assisted", "b"]
    assert "(2 rows)" in said
    assert with_known_conditions(table, ["human-assisted", "human_assisted", "c"]) == (table, "")
