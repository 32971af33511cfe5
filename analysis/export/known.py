"""The words that a study has for things: whatever else stands in a foreign table is free text."""

import pyarrow as pa
import pyarrow.compute as pc

from analysis.export.field import field_of
from protocols.laps import WHOLE_SESSION
from protocols.record.reader import Study
from protocols.record.steps import STEP_COLUMNS
from protocols.record.tables import LAP_COLUMNS, PARTICIPANT_COLUMNS, SURVEY_COLUMNS
from protocols.shipped_parts import DRIVERS, IMPAIRMENTS

WRITTEN = frozenset({"driver", "impairment", "exclusion_reason", "order", "group"})
"""Columns of words that no list of the codebook limits."""


def known_words(study: Study) -> dict[str, frozenset[str]]:
    """Return the words that columns of a study can hold, by column; other columns hold numbers.

    Parameters
    ----------
    study
        Its protocol, course and instruments name conditions, sections, groups and parts.
    """
    protocol = study.protocol
    listed = (
        field_of(column)
        for columns in (PARTICIPANT_COLUMNS, LAP_COLUMNS, SURVEY_COLUMNS, STEP_COLUMNS)
        for column in columns
        if pa.types.is_string(column.type)
    )
    known = {f.name: frozenset(map(str, f.values)) for f in listed if f.values}
    orders = {order for order in study.participants["order"].to_pylist() if order is not None}
    impairments = {choice.use for choice in protocol.cohort.impairments}
    return known | {
        "driver": frozenset({protocol.cohort.driver.use, "recorded", *DRIVERS}),
        "impairment": frozenset({"none", *impairments, *IMPAIRMENTS}),
        "exclusion_reason": frozenset(),
        "order": frozenset(o for o in orders if set(o.split(" > ")) <= set(protocol.conditions)),
        "group": frozenset(protocol.groups),
        "section": frozenset(s.name for course in study.courses for s in course.sections),
    }


def of_the_study(rows: pa.Table, study: Study) -> pa.Table:
    """Return the rows of conditions, instruments and items that the study has."""
    names = {
        "condition": {*study.protocol.conditions, WHOLE_SESSION},
        "instrument": {instrument.name for instrument in study.instruments},
        "item": {item.id for instrument in study.instruments for item in instrument.items},
    }
    for column, known in names.items():
        if column in rows.column_names:
            rows = rows.filter(pc.is_in(rows[column], pa.array(sorted(known), pa.string())))
    return rows
