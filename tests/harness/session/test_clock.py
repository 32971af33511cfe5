"""A lap runs as fast as it can, or as fast as a person lives."""

from harness.session.clock import VirtualClock, WallClock


def test_a_virtual_clock_never_waits(monkeypatch):
    """Simulated laps never sleep."""
    monkeypatch.setattr("time.sleep", lambda _: (_ for _ in ()).throw(AssertionError))
    clock = VirtualClock()
    clock.start()
    clock.wait_until(1e9)


def test_a_wall_clock_waits_for_the_rest_of_the_step_only(monkeypatch):
    """What the step itself took is not waited for again; a late step is not made up for."""
    now, slept = [100.0], []

    def sleep(seconds):
        slept.append(seconds)
        now[0] += seconds

    monkeypatch.setattr("time.monotonic", lambda: now[0])
    monkeypatch.setattr("time.sleep", sleep)
    clock = WallClock()
    clock.start()
    now[0] += 0.03
    clock.wait_until(0.1)
    now[0] += 0.25  # this step takes too long
    clock.wait_until(0.2)
    now[0] += 0.02
    clock.wait_until(0.3)
    assert [round(s, 9) for s in slept] == [0.07, 0.08]
