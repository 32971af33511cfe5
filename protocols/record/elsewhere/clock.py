"""Clocks of other programs, brought to the lap's start, or named where they contradict the lap."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Units in which loggers count, in s; seconds are tried first."""

_NAMES = {"ms": "milliseconds", "us": "microseconds", "ns": "nanoseconds"}
_FASTEST, _SLOWEST = 0.0005, 10.0
"""Lengths of a step that are plausible, s."""

_LONGEST = 3 * 3600.0
_EPOCH = 1e8
"""A clock beyond this many seconds counts from 1970 and not from a program's start."""


NOT_INCREASING = "t_s does not increase from step to step: measures that need the time are missing"
"""What is said of times out of which no step has a length."""


class Clock(NamedTuple):
    """Times of a lap's steps from its start, s, and what was done to them, in words."""

    t_s: NDArray[np.float64]
    remarks: tuple[str, ...]


def lap_clock(t: NDArray[np.float64], lasted: Sequence[float]) -> Clock:
    """Bring the times of a lap's steps to its start.

    Parameters
    ----------
    t
        As recorded, shape (n,); NaN where missing.
    lasted
        How long the lap took by each column that has a time, s; empty when none has.

    Returns
    -------
    Clock
        The times, and a remark where they were in another unit or counted from another moment. All
        NaN where they contradict how long the lap took: then it is unknown which of the two is
        right.
    """
    known = t[np.isfinite(t)]
    if len(known) < 2 or not (np.diff(known) > 0).any():
        if len(known) and abs(float(known[0])) > _LONGEST:  # a stamp, and nothing to bring it to
            return Clock(np.full(len(t), np.nan), (_contradiction(()),))
        return Clock(t, ())
    ends = float(known[0]), float(known[-1])
    step = float(np.median(np.diff(known)))
    unit = _unit(ends, step, lasted)
    if unit is None:
        return Clock(np.full(len(t), np.nan), (_contradiction(lasted),))
    scale = UNITS[unit]
    remarks = []
    if unit != "s":
        remarks.append(f"t_s is in {_NAMES[unit]}: brought to seconds")
    start, end = ends[0] * scale, ends[1] * scale
    at_start = 0 <= start <= max(5 * step * scale, 0.5)
    # The lap's own clock, its first steps not recorded: then its end agrees better than its length.
    late = start >= 0 and _apart(end + step * scale, lasted) < _apart(
        end - start + step * scale, lasted
    )
    if at_start or late:
        return Clock(t * scale if scale != 1 else t, tuple(remarks))
    what = "the time of day" if start > _EPOCH else "another moment"
    remarks.append(f"t_s counts from {what}: brought to the lap's first step")
    # In the clock's own unit first: a difference of whole numbers is exact.
    return Clock((t - ends[0]) * scale, tuple(remarks))


def spans(t: NDArray[np.float64]) -> tuple[tuple[float, float], ...]:
    """Return how long a lap's steps may last, s, and the length of one, s.

    Parameters
    ----------
    t
        Times as recorded, shape (n,); NaN where missing.

    Returns
    -------
    tuple
        One for each unit in which a step has a plausible length, and for a clock that starts with
        the steps or before them; empty where the times do not go on.
    """
    known = t[np.isfinite(t)]
    if len(known) < 2 or not (np.diff(known) > 0).any():
        return ()
    ends, step = (float(known[0]), float(known[-1])), float(np.median(np.diff(known)))
    return tuple(
        (span, step * UNITS[unit])
        for unit in _plausible(step)
        for span in _spans(ends, step, UNITS[unit])
    )


def _plausible(step: float) -> list[str]:
    return [unit for unit, scale in UNITS.items() if _FASTEST <= step * scale <= _SLOWEST]


def _spans(ends: tuple[float, float], step: float, scale: float) -> list[float]:
    """Return how long steps last from the first of them, and from the clock's zero, s."""
    first, last = ends
    return [(last - first + step) * scale, *([(last + step) * scale] if first >= 0 else [])]


def _unit(ends: tuple[float, float], step: float, lasted: Sequence[float]) -> str | None:
    """Return the unit in which steps and lap agree; None where they do not in any."""
    first, last = ends
    for unit in _plausible(step):
        scale = UNITS[unit]
        if any(_agree(seconds, lasted) for seconds in _spans(ends, step, scale)):
            return unit
        if not lasted and (last - first) * scale <= _LONGEST:
            return unit
    return None


def _apart(seconds: float, lasted: Sequence[float]) -> float:
    return min((abs(seconds - wanted) for wanted in lasted), default=math.inf)


def _agree(seconds: float, lasted: Sequence[float]) -> bool:
    return any(abs(seconds - wanted) <= max(1.0, 0.05 * wanted) for wanted in lasted)


def _contradiction(lasted: Sequence[float]) -> str:
    against = "does not last as long as the lap (lap_time_s, duration_s)"
    what = against if lasted else "is not seconds of a lap"
    return f"t_s {what}: measures that need the time are missing"
