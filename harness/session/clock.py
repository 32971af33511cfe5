"""Time in a lap: as fast as the computer can, or real time for people."""

import threading
import time
from dataclasses import dataclass
from typing import Literal, Protocol

StopReason = Literal["comfortable", "stopped", "disconnected", "interrupted"]
"""A participant ends a practice lap; the experimenter stops the lap; a person's connection was
lost; the program itself ended."""

CATCH_UP_S = 0.05
"""A step that starts later than this moves the lap's zero; a smaller delay is caught up, s."""


class LapStoppedError(Exception):
    """The lap ends before its last gate, because the clock was stopped.

    Parameters
    ----------
    reason
        As the record has it.
    note
        Why, in the words of the person who stopped it.
    """

    def __init__(self, reason: StopReason, note: str | None = None) -> None:
        super().__init__(reason, note)
        self.reason: StopReason = reason
        self.note = note


@dataclass(frozen=True, slots=True)
class Timing:
    """How late a step started by the wall clock.

    Attributes
    ----------
    late_s
        From the moment the step was due to the moment it started, s; 0 or more.
    shift_s
        How far the lap's zero moved before the step for that reason, s; 0 or more.
    paused_s
        How long the lap was paused before the step, s; 0 or more.
    """

    late_s: float
    shift_s: float
    paused_s: float


class Clock(Protocol):
    """Paces a lap's control steps."""

    def start(self, t: float = 0.0) -> Timing | None:
        """Start at lap time ``t``, s. Returns the first step's timing."""

    def wait_until(self, t: float) -> Timing | None:
        """Return once ``t`` seconds of the lap have passed; None where nothing is real time.

        Raises
        ------
        LapStoppedError
            When the lap is to end now.
        """


class VirtualClock:
    """Simulated time: no step waits, and none is late."""

    def start(self, t: float = 0.0) -> None:
        """Nothing to set."""

    def wait_until(self, t: float) -> None:
        """Return at once."""


class WallClock:
    """Real time, for living people; another thread may pause, resume and stop it.

    Deadlines are absolute: a small delay does not add up. After a long one, zero moves by the
    delay, so that steps after a late one do not follow each other faster. Lap time excludes
    pauses. A pause made between two laps holds the next one before its first step.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._zero = time.monotonic()
        self._paused_at: float | None = None
        self._paused_s = 0.0
        self._stop: LapStoppedError | None = None

    def start(self, t: float = 0.0) -> Timing:
        """Set zero so that the lap has reached ``t`` now; an earlier stop is over.

        A pause is not: it is waited for, and is no part of the lap.

        Raises
        ------
        LapStoppedError
            When ``stop`` is called meanwhile.
        """
        with self._changed:
            self._stop = None
            while self._paused_at is not None and self._stop is None:
                self._changed.wait()
            if self._stop is not None:
                raise self._stop
            self._zero = time.monotonic() - t
            self._paused_s = 0.0
        return Timing(0.0, 0.0, 0.0)

    def wait_until(self, t: float) -> Timing:
        """Sleep until ``t`` seconds have passed since zero, pauses apart.

        Raises
        ------
        LapStoppedError
            As soon as ``stop`` is called.
        """
        with self._changed:
            while True:
                if self._stop is not None:
                    raise self._stop
                left = self._zero + t - time.monotonic()
                if self._paused_at is not None:
                    self._changed.wait()
                elif left > 0:
                    self._changed.wait(left)
                else:
                    return self._timing(-left)

    def pause(self) -> None:
        """Pause the lap before its next step; does nothing while it is paused."""
        with self._changed:
            if self._paused_at is None:
                self._paused_at = time.monotonic()
                self._changed.notify_all()

    def resume(self) -> None:
        """Resume the lap; does nothing unless it is paused."""
        with self._changed:
            if self._paused_at is not None:
                paused = time.monotonic() - self._paused_at
                self._zero += paused
                self._paused_s += paused
                self._paused_at = None
                self._changed.notify_all()

    def stop(self, reason: StopReason = "stopped", note: str | None = None) -> None:
        """End the lap before its next step."""
        with self._changed:
            self._stop = LapStoppedError(reason, note)
            self._changed.notify_all()

    def _timing(self, late: float) -> Timing:
        shift = late if late > CATCH_UP_S else 0.0
        self._zero += shift
        paused, self._paused_s = self._paused_s, 0.0
        return Timing(late, shift, paused)
