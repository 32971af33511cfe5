"""Rows as sessions fill them in, and the tables' columns."""

from dataclasses import fields
from typing import get_args

import pytest

from protocols.record.rows import EndReason, LapRow, ParticipantRow, SurveyRow, participant_id
from protocols.record.tables import (
    END_REASONS,
    LAP_COLUMNS,
    PARTICIPANT_COLUMNS,
    SURVEY_COLUMNS,
)


@pytest.mark.parametrize(
    ("row", "columns"),
    [(ParticipantRow, PARTICIPANT_COLUMNS), (LapRow, LAP_COLUMNS), (SurveyRow, SURVEY_COLUMNS)],
)
def test_a_row_has_the_columns_of_its_table(row: type, columns: tuple):
    """Names and order agree, and exactly the nullable columns may be None."""
    assert [field.name for field in fields(row)] == [column.name for column in columns]
    may_be_none = [field.name for field in fields(row) if "None" in str(field.type)]
    assert may_be_none == [column.name for column in columns if column.nullable]


def test_end_reasons_agree():
    """The row's type allows what the codebook says."""
    assert get_args(EndReason) == END_REASONS


def test_ids_sort_as_numbers_do():
    """Up to 9999 participants, the order of ids is the order of numbers."""
    ids = [participant_id(n) for n in (1, 9, 10, 999, 1000, 9999)]
    assert ids == sorted(ids)
    assert ids[0] == "P0001"
