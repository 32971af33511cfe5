"""A lap's steps as measures use them: streams of numbers, missing where nothing was recorded."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, wraps
from typing import Any, Concatenate, ParamSpec, TypeVar, cast

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from analysis.measures.episodes import Episode, episodes
from protocols.record.elsewhere.clock import NOT_INCREASING
from protocols.record.steps import STEP_COLUMNS
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

BOUNDS = {"p_help": (0.0, 1.0)}
"""Columns whose numbers have a lowest and a highest; what lies outside counts as missing."""

_MEASURED = tuple(c.name for c in STEP_COLUMNS if pa.types.is_floating(c.type))

Numbers = NDArray[np.float64]
Flags = NDArray[np.bool_]

P = ParamSpec("P")
R = TypeVar("R")


@dataclass(frozen=True, eq=False)
class Steps:
    """One lap's steps, one row per control step.

    Attributes
    ----------
    table
        With columns of ``protocols.record.steps``, as ``Study.steps`` returns it.
    known
        What has been worked out of it: each thing once, however many measures ask for it.
    """

    table: pa.Table
    known: dict[Any, Any] = field(default_factory=dict, init=False, repr=False)

    def __len__(self) -> int:
        return int(self.table.num_rows)

    @cached_property
    def columns(self) -> Mapping[str, pa.ChunkedArray]:
        """The columns by name."""
        return dict(zip(self.table.column_names, self.table.columns, strict=True))


def once_per_lap(
    function: Callable[Concatenate[Steps, P], R],
) -> Callable[Concatenate[Steps, P], R]:
    """Have a function of a lap's steps keep its answer with them; nobody may change that."""

    @wraps(function)
    def answer(steps: Steps, *args: P.args, **kwargs: P.kwargs) -> R:
        key = (function, args, tuple(kwargs.items()))
        if key not in steps.known:
            steps.known[key] = function(steps, *args, **kwargs)
        kept: R = steps.known[key]
        return kept

    return cast("Callable[Concatenate[Steps, P], R]", answer)


@once_per_lap
def stream(steps: Steps, name: str) -> Numbers:
    """Return a column as numbers; all NaN when it was not recorded.

    What is missing, infinite, or out of its ``BOUNDS`` is NaN: no measure ever sees it.
    """
    values = _as_recorded(steps, name)
    wrong = np.isinf(values)
    if name in BOUNDS:
        wrong |= _out_of_bounds(values, name)
    return np.where(wrong, np.nan, values) if wrong.any() else values


@once_per_lap
def period(steps: Steps) -> float:
    """Return the length of a control step in s.

    Returns
    -------
    float
        NaN for fewer than two steps, and where time does not increase from step to step: whole
        seconds at 10 Hz, or steps out of order, do not show how long anything took.
    """
    passed = np.diff(stream(steps, "t_s"))
    return float(np.median(passed)) if len(passed) and (passed > 0).all() else float("nan")


def words(steps: Steps, name: str) -> NDArray[np.object_]:
    """Return a column of words, None where missing; a KeyError when there is no such column."""
    return np.asarray(steps.columns[name].to_numpy(), dtype=object)


def recorded(steps: Steps, name: str) -> bool:
    """Tell whether any step has a value in a column."""
    column = steps.columns.get(name)
    return column is not None and not pc.all(pc.is_null(column, nan_is_null=True)).as_py()


def gaps(steps: Steps) -> tuple[str, ...]:
    """Name what cannot be used of a lap's steps although it was recorded, and the consequence.

    Examples
    --------
    >>> gaps(Steps(pa.table({"p_help": [0.5, 7.0]})))
    ('p_help is not between 0 and 1 in some steps: missing there',)
    """
    return tuple(_gaps(steps))


def _gaps(steps: Steps) -> Iterator[str]:
    for name in _MEASURED:
        values = _as_recorded(steps, name)
        if np.isinf(values).any():
            yield f"{name} is infinite in some steps: missing there"
        if name in BOUNDS and _out_of_bounds(values[np.isfinite(values)], name).any():
            low, high = BOUNDS[name]
            yield f"{name} is not between {low:g} and {high:g} in some steps: missing there"
    t = stream(steps, "t_s")
    if len(t) > 1 and not np.isnan(t).all() and np.isnan(period(steps)):
        yield NOT_INCREASING


@once_per_lap
def _as_recorded(steps: Steps, name: str) -> Numbers:
    column = steps.columns.get(name)
    if column is None:
        return np.full(len(steps), np.nan)
    floats = column if pa.types.is_float64(column.type) else column.cast(pa.float64())
    return np.asarray(floats.to_numpy())


def _out_of_bounds(values: Numbers, name: str) -> Flags:
    low, high = BOUNDS[name]
    return np.asarray((values < low) | (values > high))


@once_per_lap
def helped(steps: Steps) -> Flags | None:
    """Return in which steps an assistant's command counted; None when control was not recorded."""
    control = steps.columns.get("control")
    if control is None or len(steps) == 0 or control.null_count:
        return None
    return np.asarray(pc.not_equal(control, "driver").to_numpy())


@once_per_lap
def stretches_of_help(steps: Steps) -> list[Episode] | None:
    """Return the unbroken stretches of assistance; None when control was not recorded."""
    on = helped(steps)
    return None if on is None else episodes(on)


@once_per_lap
def would_help(steps: Steps) -> Flags | None:
    """Return in which steps the shadow demonstrator would help; None when it was not recorded."""
    h = stream(steps, "h_would")
    if len(h) == 0 or np.isnan(h).any():
        return None
    return np.asarray(h > 0)


@once_per_lap
def command(steps: Steps, who: str) -> Numbers:
    """Return commands in shares of full deflection.

    Parameters
    ----------
    steps
        A lap's steps.
    who
        Stem of the columns: ``intent``, ``user``, ``arbitrated``, ``executed``, ``a``, ``would``,
        ``mean``, ``result``.

    Returns
    -------
    NDArray
        Shape (steps, 2): v over the top speed, w over the top turn rate. Both are then of order 1,
        so that a norm or an angle between two commands means something.
    """
    v, w = stream(steps, f"{who}_v"), stream(steps, f"{who}_w")
    return np.column_stack([v / MAX_SPEED, w / MAX_TURN_RATE])
