"""Columns and the Arrow schema they make."""

import pyarrow as pa

from protocols.record.column import Column, arrow_schema


def test_a_schema_keeps_order_type_and_whether_values_may_be_missing():
    """Columns become fields, one by one."""
    schema = arrow_schema(
        (Column("a", pa.int8(), "A"), Column("b", pa.string(), "B", nullable=True))
    )
    assert schema.names == ["a", "b"]
    assert [field.nullable for field in schema] == [False, True]
