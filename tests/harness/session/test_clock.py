"""A lap runs as fast as it can, or as fast as a person lives."""

import threading
import time

import pytest

from harness.session.clock import CATCH_UP_S, LapStoppedError, VirtualClock, WallClock


def test_a_virtual_clock_never_waits():
    """Simulated laps never sleep, and have no lateness."""
    clock = VirtualClock()
    begun = time.monotonic()
    assert clock.start() is None
    assert clock.wait_until(1e9) is None
    assert time.monotonic() - begun < 1


@pytest.fixture
def clock(monkeypatch):
    """Return a wall clock whose time is ours to move; sleeping moves it."""
    now = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    clock = WallClock()

    def wait(seconds=None):
        assert seconds is not None
        now[0] += seconds

    monkeypatch.setattr(clock._changed, "wait", wait)
    clock.now = now
    clock.start()
    return clock


def test_deadlines_are_absolute(clock):
    """A small delay is caught up: it does not add up over a lap."""
    clock.now[0] = 100.11
    first = clock.wait_until(0.1)
    assert first.late_s == pytest.approx(0.01)
    assert first.shift_s == 0.0
    second = clock.wait_until(0.2)
    assert clock.now[0] == pytest.approx(100.2)
    assert second.late_s == pytest.approx(0.0, abs=1e-9)


def test_a_late_step_is_not_made_up_for_by_hurrying(clock):
    """A long delay moves zero by as much, and says so."""
    clock.now[0] = 100.35
    late = clock.wait_until(0.1)
    assert late.late_s == late.shift_s == pytest.approx(0.25)
    assert late.late_s > CATCH_UP_S
    clock.wait_until(0.2)
    assert clock.now[0] == pytest.approx(100.45)


def test_pauses_are_not_lap_time(clock):
    """A paused lap waits; the pause moves zero, and is reported once."""
    clock.pause()
    clock.now[0] += 7.0
    clock.resume()
    clock.resume()  # nothing to resume
    timing = clock.wait_until(0.1)
    assert clock.now[0] == pytest.approx(107.1)
    assert timing.paused_s == pytest.approx(7.0)
    assert timing.shift_s == 0.0
    assert clock.wait_until(0.2).paused_s == 0.0


def test_a_lap_can_begin_in_its_middle(clock):
    """A session that resumes after a restart has driven some of its lap already."""
    clock.start(12.3)
    clock.wait_until(12.4)
    assert clock.now[0] == pytest.approx(100.1)


@pytest.mark.parametrize("paused", [False, True])
def test_a_stop_ends_the_lap_at_once(paused):
    """Another thread's stop wakes the waiting lap, paused or not, with reason and note."""
    clock = WallClock()
    clock.start()
    if paused:
        clock.pause()
    threading.Timer(0.05, clock.stop, args=("disconnected", "the tab was closed")).start()
    begun = time.monotonic()
    with pytest.raises(LapStoppedError) as stop:
        clock.wait_until(60.0)
    assert time.monotonic() - begun < 5
    assert (stop.value.reason, stop.value.note) == ("disconnected", "the tab was closed")
    clock.resume()
    clock.start()
    assert clock.wait_until(0.0).late_s < 1.0


def test_pause_and_resume_from_another_thread():
    """The experimenter's hands are on another thread than the lap."""
    clock = WallClock()
    clock.start()
    clock.pause()
    threading.Timer(0.1, clock.resume).start()
    timing = clock.wait_until(0.01)
    assert 0.05 < timing.paused_s < 5


def test_a_pause_between_laps_holds_the_next_one():
    """The experimenter pauses on a page: the lap that follows waits, and its time begins then."""
    clock = WallClock()
    clock.pause()
    threading.Timer(0.1, clock.resume).start()
    begun = time.monotonic()
    assert clock.start().paused_s == 0.0
    assert time.monotonic() - begun > 0.05
    assert clock.wait_until(0.0).late_s < 1.0


def test_a_held_lap_can_be_stopped():
    """A lap that a pause holds before its first step ends at once, with its reason."""
    clock = WallClock()
    clock.pause()
    threading.Timer(0.05, clock.stop, args=("stopped", "not today")).start()
    with pytest.raises(LapStoppedError) as stop:
        clock.start()
    assert (stop.value.reason, stop.value.note) == ("stopped", "not today")
