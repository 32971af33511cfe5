"""Collect a lap's steps cheaply, and turn them into the step table once."""

from collections.abc import Mapping, Sequence
from operator import itemgetter
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lad.inputs import INPUT_NAMES, N_INPUTS
from protocols.record.steps import STEP_COLUMNS, STEP_SCHEMA

_STREAMS = tuple(c for c in STEP_COLUMNS if c.name not in INPUT_NAMES)
_REQUIRED = frozenset(c.name for c in _STREAMS if not c.nullable)
_KNOWN = frozenset(c.name for c in _STREAMS)
_NAMES = tuple(c.name for c in _STREAMS)
_VALUES = itemgetter(*_NAMES)


class StepRecorder:
    """The steps of one lap.

    A step costs a few microseconds; names, types and missing values are checked once, when the
    table is made.

    Examples
    --------
    >>> recorder = StepRecorder()
    >>> len(recorder)
    0
    """

    def __init__(self) -> None:
        self._inputs: list[NDArray[np.float64]] = []
        self._streams: list[Mapping[str, Any]] = []

    def __len__(self) -> int:
        return len(self._streams)

    def append(self, x: NDArray[np.float64], **streams: Any) -> None:
        """Add a step.

        Parameters
        ----------
        x
            Shape (19,): the model's inputs, in the order of ``lad.inputs.INPUT_NAMES``; copied.
        **streams
            The step's other columns by name (``protocols.record.steps``). A nullable column may
            be left out or None.
        """
        self._inputs.append(x.copy())
        self._streams.append(streams)

    def table(self) -> pa.Table:
        """Return the lap as a table of ``STEP_SCHEMA``.

        Raises
        ------
        ValueError
            When a step lacks a column that may not be missing, has an unknown column, or
            holds a value of the wrong type, NaN or infinity; names the column.
        """
        self._check_names()
        inputs = np.array(self._inputs, dtype=np.float64).reshape(len(self), N_INPUTS)
        streams = self._columns()
        columns = []
        for column in STEP_COLUMNS:
            if column.name in INPUT_NAMES:
                values: Any = np.ascontiguousarray(inputs[:, INPUT_NAMES.index(column.name)])
            else:
                values = streams[column.name]
            columns.append(_array(column.name, column.type, values, nullable=column.nullable))
        return pa.Table.from_arrays(columns, schema=STEP_SCHEMA)

    def _columns(self) -> dict[str, Sequence[Any]]:
        """Return the values of each column; names are checked, so as many as all is all."""
        rows = [
            _VALUES(step) if len(step) == len(_NAMES) else tuple(map(step.get, _NAMES))
            for step in self._streams
        ]
        values = zip(*rows, strict=True) if rows else [()] * len(_NAMES)
        return dict(zip(_NAMES, values, strict=True))

    def _check_names(self) -> None:
        shapes: dict[tuple[str, ...], int] = {}
        for i, step in enumerate(self._streams):
            shapes.setdefault(tuple(step), i)
        for names, i in shapes.items():
            if missing := _REQUIRED.difference(names):
                raise ValueError(f"step {i} lacks {', '.join(sorted(missing))}")
            if unknown := set(names) - _KNOWN:
                raise ValueError(f"step {i} has unknown columns: {', '.join(sorted(unknown))}")


def _array(name: str, kind: pa.DataType, values: Any, *, nullable: bool) -> pa.Array:
    try:
        array = pa.array(values, type=kind)
    except (pa.ArrowInvalid, pa.ArrowTypeError, OverflowError) as error:
        raise ValueError(f"column {name}: {error}") from error
    if not nullable and array.null_count:
        raise ValueError(f"column {name}: missing in step {array.is_null().index(True).as_py()}")
    if pa.types.is_floating(kind):
        bad = np.flatnonzero(~np.isfinite(array.drop_null().to_numpy()))
        if len(bad):
            raise ValueError(f"column {name}: {len(bad)} values are not finite")
    return array
