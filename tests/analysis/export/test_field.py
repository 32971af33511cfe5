"""Columns as other formats describe them."""

import pyarrow as pa

from analysis.export.field import field_of, kind_of
from protocols.record.codebook import TABLES

# Words of the codebook that say more than a list or a range of numbers.
IN_WORDS = {"none, or its name", "1 to the scale's points"}


def test_every_limit_in_the_codebook_is_understood():
    """A column with a limit in words becomes a field with a limit, but for those listed here."""
    for columns in TABLES.values():
        for column in columns:
            if pa.types.is_nested(column.type) or not column.allowed:
                continue
            field = field_of(column)
            limited = field.values or (field.minimum, field.maximum, field.above) != (None,) * 3
            assert bool(limited) != (column.allowed in IN_WORDS), column.name


def test_units_and_descriptions_are_the_codebooks():
    """What a column is stands in one place."""
    for column in TABLES["steps"]:
        field = field_of(column)
        assert (field.unit, field.description) == (column.unit, column.description)


def test_a_number_that_others_would_round_is_text():
    """Seeds have 64 bits without a sign; R and JavaScript have no such number."""
    seed = next(c for c in TABLES["laps"] if c.name == "seed")
    assert field_of(seed).kind == "string"
    assert kind_of(pa.int8()) == "integer"
