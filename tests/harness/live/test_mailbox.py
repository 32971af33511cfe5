"""A seat keeps the newest input and its age; an old one never acts."""

import threading
import time

import pytest

from harness.live.mailbox import Mailbox
from harness.live.messages import Stick
from harness.session.clock import LapStoppedError
from lad.command import STILL, Command
from participants.driver import WithdrewError
from participants.live.demonstrator import LiveDemonstrator
from participants.live.driver import MOST_AGE_S, LiveDriver
from participants.live.seat import Request


def stick(n, sent_s, forward=1.0, *, clutch=False):
    """Return a stick's message."""
    return Stick(n=n, sent=1000 * sent_s, f=forward, l=0.0, c=clutch)


@pytest.fixture
def seat(monkeypatch):
    """Return a connected seat whose time is ours to move."""
    now = [50.0]
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    mailbox = Mailbox()
    mailbox.now = now
    mailbox.number = mailbox.connect(lambda: None)
    return mailbox


def test_the_newest_input_counts_with_its_age(seat):
    """Age is by the sender's clock, so a burst after a stall is known to be old."""
    seat.put_stick(stick(1, 10.0, 0.1))
    assert seat.latest().age_s == pytest.approx(0.0)
    seat.now[0] += 2.0  # the network stalls for two seconds, then delivers all at once
    for n in range(2, 12):
        seat.put_stick(stick(n, 10.0 + 0.05 * n, 0.9))
    late = seat.latest()
    assert late.sequence == 11
    assert late.age_s == pytest.approx(2.0 - 0.55)
    assert late.age_s > MOST_AGE_S


def test_a_message_out_of_order_is_dropped(seat):
    """What was sent before is not taken after."""
    seat.put_stick(stick(5, 10.5, 0.5))
    seat.put_stick(stick(4, 10.4, 0.4))
    assert seat.latest().forward == 0.5


def test_a_lost_connection_leaves_no_input(seat):
    """Neither does an earlier connection's stick act for the next one."""
    seat.put_stick(stick(1, 10.0))
    seat.disconnect(seat.number)
    assert seat.latest() is None
    seat.connect(lambda: None)
    assert seat.latest() is None


class Sees:
    """Stands in for what there is to see."""

    t, pose, velocity, ranges = 0.0, (0.0, 0.0, 0.0), Command(0.0, 0.0), ()
    gates_passed, helped, contact = 0, False, False


class Told:
    """A seat that gives what it is told to."""

    def __init__(self, mailbox):
        self.latest, self.withdrawal = mailbox.latest, mailbox.withdrawal

    def show(self, picture):
        pass


def test_old_inputs_never_act(seat, monkeypatch):
    """A repeated input is no new command; a stale one, and a lost link, are a command to stand."""
    from protocols.pose import Pose

    monkeypatch.setattr(Sees, "pose", Pose(0.0, 0.0, 0.0))
    driver, demonstrator = LiveDriver(Told(seat)), LiveDemonstrator(Told(seat))
    seat.put_stick(stick(1, 10.0, clutch=True))
    assert driver.act(Sees()) == Command(0.7, 0.0)
    assert demonstrator.assist([0.0, 0.0]).helping
    assert driver.act(Sees()) is None
    seat.now[0] += 0.5
    seat.put_stick(stick(2, 10.1, clutch=True))
    assert driver.act(Sees()) == STILL
    assert not demonstrator.assist([0.0, 0.0]).helping
    seat.disconnect(seat.number)
    assert driver.act(Sees()) == STILL
    seat.connect(lambda: None)
    seat.put_stick(stick(1, 10.5))  # a page that was opened again counts from 1
    assert driver.act(Sees()) == Command(0.7, 0.0)


def test_a_page_waits_for_its_own_answer():
    """An answer to an earlier page is dropped; what is entered comes back."""
    seat = Mailbox()
    threading.Timer(0.05, seat.put_answer, (7, {"a": 0})).start()
    threading.Timer(0.1, seat.put_answer, (1, {"a": 1})).start()
    assert seat.ask(Request("questions")) == {"a": 1}


def test_a_withdrawal_ends_a_page():
    """Whoever wants to stop need not answer first."""
    seat = Mailbox()
    threading.Timer(0.05, seat.withdraw, ("enough",)).start()
    with pytest.raises(WithdrewError, match="enough"):
        seat.ask(Request("consent"))


def test_a_session_that_is_ended_leaves_its_pages():
    """Nothing waits for ever."""
    seat = Mailbox()
    threading.Timer(0.05, seat.end, (LapStoppedError("interrupted"),)).start()
    begun = time.monotonic()
    with pytest.raises(LapStoppedError):
        seat.ask(Request("ready"))
    assert time.monotonic() - begun < 5
