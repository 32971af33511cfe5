"""Values of another program's column, turned into our type: the same values, or a refusal."""

from pathlib import Path

import pyarrow as pa
import pyarrow.compute as pc

from protocols.files.errors import InputError
from protocols.record.column import Column

_PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}


def converted(
    array: pa.ChunkedArray, column: Column, path: Path, *, clock: bool
) -> pa.ChunkedArray:
    """Return a column in our type.

    Parameters
    ----------
    array
        As it was read.
    column
        What it is to be.
    path
        Its file, for the message.
    clock
        Whether a date and time, or a duration, is understood as seconds.

    Raises
    ------
    InputError
        When a value would not be the same in our type.
    """
    if array.type.equals(column.type):
        return array
    try:
        return _plain(array, column.type, clock=clock).cast(column.type)
    except (pa.ArrowException, TypeError, ValueError, OverflowError) as error:
        reason = str(error).partition("\n")[0].rstrip(".")
        raise InputError(
            f"{path}: column {column.name} is {array.type}; allowed: {column.type} ({reason})"
        ) from None


def _plain(array: pa.ChunkedArray, wanted: pa.DataType, *, clock: bool) -> pa.ChunkedArray:
    """Return values that a cast to the wanted type cannot change without saying so."""
    if pa.types.is_dictionary(array.type):
        array = array.cast(array.type.value_type)
    given = array.type
    if clock and _counts_time(given):
        return _seconds_or_counts(array)
    if pa.types.is_nested(given):
        raise ValueError("several values in one place")
    if pa.types.is_decimal(given):
        array, given = array.cast(pa.float64()), pa.float64()
    # What pandas writes for integers with gaps: floats, and NaN for the gaps.
    if pa.types.is_floating(given) and not pa.types.is_floating(wanted):
        array = pc.if_else(pc.is_nan(array), None, array)
        if pa.types.is_string(wanted) and _all(pc.equal(pc.floor(array), array)):
            return array.cast(pa.int64())  # 1.0 is the id 1
    if pa.types.is_boolean(wanted) and (pa.types.is_integer(given) or pa.types.is_floating(given)):
        if not _all(pc.is_in(array, pa.array([0, 1, None], array.type))):
            raise ValueError("a truth value is 0 or 1")
    elif pa.types.is_boolean(given) and not pa.types.is_string(wanted):
        raise ValueError("a truth value is no number")
    return array


def _counts_time(kind: pa.DataType) -> bool:
    kinds = (pa.types.is_integer, pa.types.is_timestamp, pa.types.is_duration)
    return any(is_one(kind) for is_one in kinds)


def _seconds_or_counts(array: pa.ChunkedArray) -> pa.ChunkedArray:
    """Return dates and durations in seconds, and whole numbers of an unknown unit as floats.

    Nanoseconds since 1970 have more digits than a float: they are known to 256 ns then.
    """
    counts = array.cast(pa.int64()).cast(pa.float64(), safe=False)
    if pa.types.is_integer(array.type):
        return counts
    return pc.divide(counts, _PER_SECOND[array.type.unit])


def _all(truths: pa.ChunkedArray) -> bool:
    return bool(pc.all(truths, min_count=0).as_py())
