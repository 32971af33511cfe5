"""The checks that parts of every role share, each from the evidence that was gathered."""

from collections.abc import Sequence

from harness.part_checks.fault import Fault
from harness.part_checks.play import Played, first_difference
from harness.part_checks.result import CheckResult
from harness.part_checks.source import PartSource

LAPS = "laps"
SAME = "same seed, same answers"
UNCHANGED = "leaves what it is given as it is"
TIME = "time per step"

WARM_UP = 5
"""Steps at a lap's start whose time does not count: code is compiled and caches are filled."""

SHARE = 0.5
"""A part may take up to this share of the control period; the rest of the lap needs time, too."""

QUANTILE = 0.95
"""Of the steps, this share must be in time: a busy machine is no fault of the part."""


def goes_through_laps(
    fault: Fault | None, laps: Sequence[Sequence[object]], *, drives: bool
) -> CheckResult:
    """Check that nothing was raised in a session's first lap."""
    steps = sum(map(len, laps))
    found = f"{steps} steps of {len(laps)} laps without an error"
    wrong = str(fault) if fault is not None else None
    allowed = "no error, except a WithdrewError of a driver who leaves" if drives else "no error"
    return CheckResult.of(LAPS, wrong, found, allowed)


def same_answers(first: Played, again: Played) -> CheckResult:
    """Check that two parts made alike, and shown the same, answer the same."""
    allowed = "two parts made with the same seed and shown the same answer the same, to the bit"
    if first.fault is not None or again.fault is not None:
        return CheckResult(SAME, "not checked", "it raises an error", allowed)
    where = first_difference(first.plain(), again.plain())
    fault = None if where is None else f"two parts made alike differ, first in {where}"
    return CheckResult.of(SAME, fault, f"{_count(first)} answers are the same twice", allowed)


def unchanged(played: Sequence[Played], source: PartSource) -> CheckResult:
    """Check that a part wrote into nothing that it was shown or made with."""
    written = next((p.changed for p in played if p.changed is not None), source.written_to())
    fault = None if written is None else f"it writes into {written}"
    allowed = "what it is shown, its options and its course are for reading; copies are its own"
    return CheckResult.of(UNCHANGED, fault, "nothing was written to", allowed)


def in_time(played: Played, period: float) -> CheckResult:
    """Check that answers come well within a control period."""
    times = sorted(second for lap in played.seconds for second in lap[WARM_UP:])
    allowed = (
        f"up to {SHARE * period * 1e3:g} ms in {QUANTILE:.0%} of the steps: half the control "
        f"period of {period:g} s"
    )
    if not times:
        return CheckResult(TIME, "not checked", "no lap was long enough", allowed)
    middle, late = (times[int(share * (len(times) - 1))] for share in (0.5, QUANTILE))
    found = (
        f"median {_ms(middle)}, {QUANTILE:.0%} within {_ms(late)}, longest {_ms(times[-1])} "
        f"of {len(times)} steps"
    )
    return CheckResult.of(TIME, found if late > SHARE * period else None, found, allowed)


def _ms(seconds: float) -> str:
    return f"{seconds * 1e3:.2g} ms" if seconds < 0.1 else f"{seconds * 1e3:.0f} ms"


def _count(played: Played) -> int:
    return sum(map(len, played.answers))
