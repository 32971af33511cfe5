"""A lap's steps as measures use them: streams of numbers, missing where nothing was recorded."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar, cast

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from protocols.record.steps import STEP_COLUMNS
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

Steps = pd.DataFrame
"""One lap's step table (``protocols.record.steps``), one row per control step."""

BOUNDS = {"p_help": (0.0, 1.0)}
"""Columns whose numbers have a lowest and a highest; what lies outside counts as missing."""

Numbers = NDArray[np.float64]
Flags = NDArray[np.bool_]

P = ParamSpec("P")
R = TypeVar("R")

_AT_HAND: ContextVar[tuple[Steps, dict[Any, Any]] | None] = ContextVar("at_hand", default=None)
"""The step table that is being measured, and what has been worked out of it."""


@contextmanager
def at_hand(steps: Steps) -> Iterator[None]:
    """Have a lap's streams worked out once each meanwhile, however many measures ask for them.

    The measures give the same without it. The step table must not change meanwhile.
    """
    token = _AT_HAND.set((steps, {}))
    try:
        yield
    finally:
        _AT_HAND.reset(token)


def once_per_lap(
    function: Callable[Concatenate[Steps, P], R],
) -> Callable[Concatenate[Steps, P], R]:
    """Keep what a function of a step table answers while the table is at hand."""

    @wraps(function)
    def answer(steps: Steps, *args: P.args, **kwargs: P.kwargs) -> R:
        now = _AT_HAND.get()
        if now is None or now[0] is not steps:
            return function(steps, *args, **kwargs)
        known, key = now[1], (function, args, tuple(kwargs.items()))
        if key not in known:
            known[key] = function(steps, *args, **kwargs)
        kept: R = known[key]
        return kept

    return cast("Callable[Concatenate[Steps, P], R]", answer)


@once_per_lap
def stream(steps: Steps, name: str) -> Numbers:
    """Return a column as numbers; all NaN when it was not recorded.

    What is missing, infinite, or out of its ``BOUNDS`` is NaN: no measure ever sees it.
    """
    values = _as_recorded(steps, name)
    wrong = np.isinf(values) | _out_of_bounds(values, name)
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


def gaps(steps: Steps) -> tuple[str, ...]:
    """Name what cannot be used of a lap's steps although it was recorded, and the consequence.

    Examples
    --------
    >>> gaps(pd.DataFrame({"p_help": [0.5, 7.0]}))
    ('p_help is not between 0 and 1 in some steps: missing there',)
    """
    return tuple(_gaps(steps))


def _gaps(steps: Steps) -> Iterator[str]:
    dtypes = steps.dtypes
    names = [c.name for c in STEP_COLUMNS if dtypes.get(c.name) == np.float64]
    infinite = np.isinf(steps[names].to_numpy()).any(axis=0)
    for name, somewhere in zip(names, infinite, strict=True):
        if somewhere:
            yield f"{name} is infinite in some steps: missing there"
        if name not in BOUNDS:
            continue
        values = _as_recorded(steps, name)
        if _out_of_bounds(values[np.isfinite(values)], name).any():
            low, high = BOUNDS[name]
            yield f"{name} is not between {low:g} and {high:g} in some steps: missing there"
    t = stream(steps, "t_s")
    if len(t) > 1 and not np.isnan(t).all() and np.isnan(period(steps)):
        yield ("t_s does not increase from step to step: measures that need the time are missing")


def _as_recorded(steps: Steps, name: str) -> Numbers:
    if name not in steps:
        return np.full(len(steps), np.nan)
    column = steps[name]
    if column.dtype == np.float64:
        return column.to_numpy()
    return pd.to_numeric(column).to_numpy(dtype=np.float64, na_value=np.nan)


def _out_of_bounds(values: Numbers, name: str) -> Flags:
    low, high = BOUNDS.get(name, (-np.inf, np.inf))
    return np.asarray((values < low) | (values > high))


@once_per_lap
def helped(steps: Steps) -> Flags | None:
    """Return in which steps an assistant's command counted; None when control was not recorded."""
    if "control" not in steps or len(steps) == 0:
        return None
    control = steps["control"].to_numpy(dtype=object)
    return None if pd.isna(control).any() else np.asarray(control != "driver", dtype=np.bool_)


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
