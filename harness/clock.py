"""Time in a lap: as fast as the computer can, or as fast as a person lives."""

import time
from typing import Protocol


class Clock(Protocol):
    """Paces a lap's control steps."""

    def start(self) -> None:
        """Set zero: the lap begins now."""

    def wait_until(self, t: float) -> None:
        """Return once ``t`` seconds of the lap have passed."""


class VirtualClock:
    """Simulated time: nobody waits."""

    def start(self) -> None:
        """Nothing to set."""

    def wait_until(self, t: float) -> None:
        """Return at once."""


class WallClock:
    """Real time, for live people. A late step is not caught up by hurrying the next ones."""

    def __init__(self) -> None:
        self._zero = time.monotonic()

    def start(self) -> None:
        """Set zero to now."""
        self._zero = time.monotonic()

    def wait_until(self, t: float) -> None:
        """Sleep until ``t`` seconds have passed since ``start``; if they have, shift zero."""
        late = time.monotonic() - self._zero - t
        if late < 0:
            time.sleep(-late)
        else:
            self._zero += late
