"""A person whose link fails stands: soon, recorded, and old inputs never act."""

import contextlib
import json
import socket
import threading
import time

import numpy as np
import pyarrow.parquet as pq
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from harness.live.server import SILENT


def protocol(seconds, participants=1):
    """Return a study of one lap of so many seconds."""
    nobody = {"demonstrator": None, "respondent": None}
    return {
        "schema": 1,
        "name": "interrupted",
        "title": "One lap",
        "cohort": {"participants": participants, "driver": {"use": "live"}, **nobody},
        "conditions": {"free": {}},
        "laps": [{"condition": "free", "time_limit_s": seconds}],
    }


class Proxy:
    """A network between browser and server that can stall, and then deliver all at once."""

    def __init__(self, served):
        self._flows = threading.Event()
        self._flows.set()
        self._sockets = contextlib.ExitStack()
        self._listener = self._sockets.enter_context(socket.create_server(("127.0.0.1", 0)))
        self.port = self._listener.getsockname()[1]
        self._server = served.port
        served.browsers.callback(self._sockets.close)
        served.browsers.callback(self.flow)
        threading.Thread(target=self._accept, daemon=True).start()

    def stall(self):
        self._flows.clear()

    def flow(self):
        self._flows.set()

    def _accept(self):
        near, _ = self._listener.accept()
        far = socket.create_connection(("127.0.0.1", self._server))
        for end in (near, far):
            self._sockets.enter_context(end)
        for source, sink in ((near, far), (far, near)):
            threading.Thread(target=self._pump, args=(source, sink), daemon=True).start()

    def _pump(self, source, sink):
        with contextlib.suppress(OSError):  # either side may go at any time
            while content := source.recv(65536):
                self._flows.wait()
                sink.sendall(content)
        sink.close()


class Browser:
    """A page made of a few lines: full speed ahead, 25 times a second."""

    def __init__(self, served, port=None, person=None):
        self.served = served
        self._n, self.t, self.person = 0, 0.0, person
        self.may_answer = threading.Event()
        self.may_answer.set()
        way = socket.create_connection(("127.0.0.1", port or served.port))
        address = f"ws://127.0.0.1:{served.port}/ws"
        self.socket = served.browsers.enter_context(
            connect(address, sock=way, origin=served.origin, max_size=2**20, open_timeout=120)
        )
        hello = {"type": "hello", "token": served.link("participant"), "person": person}
        self.socket.send(json.dumps(hello))

    def drive(self, until, **stick):
        """Send the stick until lap time ``until`` is shown; tell whether the session is over."""
        while self.t < until:
            self.push(**stick)
            if self.take(0.04):
                return True
        return False

    def push(self, forward=1.0, **more):
        self._n += 1
        stick = {"type": "input", "n": self._n, "sent": 1000 * time.monotonic()}
        self.socket.send(json.dumps({**stick, "f": forward, "l": 0.0, **more}))

    def _answer(self, page):
        self.may_answer.wait()
        reply = {"type": "answer", "request": page["request"], "entered": {}}
        with contextlib.suppress(ConnectionClosed):
            self.socket.send(json.dumps(reply))

    def stay(self):
        """Say no more than pings ask for, until the session is over."""
        try:
            while not self.take(0.5):
                pass
        except ConnectionClosed as lost:  # stalled for so long that the link counts as lost
            if lost.rcvd is None or lost.rcvd.code != SILENT:
                raise
            Browser(self.served, person=self.person).stay()

    def take(self, seconds):
        """Take what comes for a while, and answer pages and pings."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                message = json.loads(self.socket.recv(timeout=end - time.monotonic()))
            except TimeoutError:
                return False
            if message["type"] == "page":
                threading.Thread(target=self._answer, args=(message,), daemon=True).start()
            elif message["type"] == "ping":
                self.socket.send(json.dumps({"type": "pong", "id": message["id"]}))
            elif message["type"] == "welcome":
                self.person = message["person"]
            elif message["type"] == "picture":
                self.t = message["t"]
            elif message["type"] == "bye":
                return True
        return False


def steps_and_events(served):
    """Return the lap's steps and the session's events, once it is over."""
    served.wait(lambda: served.study.over)
    session = served.study.folder / "sessions" / "P0001"
    steps = pq.read_table(session / "steps-0.parquet").to_pandas()
    return steps, pq.read_table(session / "event_rows.parquet").to_pandas()


def assert_stood(steps, since, until=np.inf):
    """Assert a zero command within 0.3 s, standstill within 1.5 s, and that both stay so."""
    t = steps["t_s"].to_numpy()
    assert steps["result_v"][t < since].max() > 0.3  # it was under way
    silent = (t >= since + 0.3 - 1e-6) & (t < until)
    stands = (t >= since + 1.5 - 1e-6) & (t < until)
    assert stands.any() or until < np.inf  # the lap waits, perhaps before that
    assert (steps["intent_v"][silent] == 0).all()
    assert (steps["result_v"][stands].abs() < 0.01).all()


def test_after_a_stalled_network_old_inputs_never_act(serve):
    """What was sent in the meantime arrives in a burst, and none of it moves the chair."""
    served = serve(protocol(3.8))
    proxy = Proxy(served)
    browser = Browser(served, proxy.port)
    browser.drive(1.3)
    proxy.stall()
    since = browser.t
    for _ in range(30):
        browser.push()
        time.sleep(0.04)
    time.sleep(0.4)
    proxy.flow()
    browser.stay()
    steps, events = steps_and_events(served)
    assert_stood(steps, since)
    assert "inputs stopped" in set(events["event"])
    assert steps["driver_sent_age_s"].max() > 0.5


@pytest.mark.parametrize("how", ["closed", pytest.param("silent", marks=pytest.mark.slow)])
def test_a_lost_person_stands_and_the_lap_waits(serve, how):
    """A closed tab, or a link that says nothing any more: paused, and resumed by the next one."""
    seconds = 5.0
    served = serve(protocol(seconds))
    proxy = Proxy(served)
    browser = Browser(served, proxy.port)
    browser.drive(1.3)
    since = browser.t
    if how == "closed":
        browser.socket.close()
    else:
        proxy.stall()
    visit = served.study.visits["P0001"]
    served.wait(lambda: "lost participant" in visit.snapshot()["paused"])
    again = Browser(served, person=browser.person)  # a reloaded page counts its inputs from 1
    while not again.drive(np.inf):
        pass
    steps, events = steps_and_events(served)
    back = steps["t_s"][(steps["t_s"] > since + 1) & (steps["intent_v"] > 0)].min()
    assert back < seconds  # the new page's first inputs act
    assert_stood(steps, since, back)
    assert list(events["event"][events["event"].isin(["disconnected", "pause", "resume"])]) == [
        "disconnected", "pause", "resume",
    ]  # fmt: skip
    assert pq.read_table(served.study.folder / "laps.parquet")["pauses"].to_pylist() == [1]


def test_a_pause_on_a_page_holds_the_lap_that_follows(serve):
    """Paused before the lap, the chair does not take a step until the experimenter resumes."""
    served = serve(protocol(1.0))
    browser = Browser(served)
    browser.may_answer.clear()
    browser.take(1.0)
    visit = served.study.visits["P0001"]
    visit.pause("experimenter")
    browser.may_answer.set()
    for _ in range(10):  # through every page, and longer than the lap would take
        browser.take(0.2)
    assert visit.snapshot()["stage"] == "lap"
    assert "t" not in visit.snapshot()
    visit.resume("experimenter")
    while not browser.drive(np.inf):
        pass
    steps, events = steps_and_events(served)
    assert len(steps) == 10
    assert steps["late_s"].max() < 1
    assert {"pause", "resume"} <= set(events["event"])


def test_a_page_that_is_left_is_an_event(serve):
    """Hidden or blurred, another device, back again: each is recorded with its step."""
    served = serve(protocol(3.0))
    browser = Browser(served)
    browser.drive(1.0, dev="gamepad")
    browser.drive(2.0, forward=0.0, att=False)
    browser.drive(9.0)
    steps, events = steps_and_events(served)
    named = events[events["event"].isin(["page left", "page is back", "device"])]
    assert list(named["event"]) == ["page left", "device", "page is back"]
    assert list(named["note"])[1] == "gamepad to keyboard"
    assert named["step"].between(9, 30).all()
    assert not steps["driver_attentive"].all()


def test_several_sessions_at_a_time(serve):
    """Each browser that opens the participants' link gets a session of its own, up to the seats."""
    served = serve(protocol(1.0, participants=3), seats=2)
    browsers = [Browser(served) for _ in range(2)]
    for browser in browsers:
        browser.may_answer.clear()
        threading.Thread(target=browser.drive, args=(np.inf,), daemon=True).start()
    served.wait(lambda: len(served.study.visits) == 2)
    third = served.open("participant")
    assert json.loads(third.recv(timeout=60))["type"] == "full"
    for browser in browsers:
        browser.may_answer.set()
    served.wait(lambda: len(served.study.progress().finished) == 2)
    last = Browser(served)
    while not last.drive(np.inf):
        pass
    served.wait(lambda: served.study.over)
    assert served.study.progress().finished == ("P0001", "P0002", "P0003")


@pytest.mark.parametrize("late_s", [0.001, 0.4])
def test_a_machine_that_is_too_busy_is_said_so_before_the_lap(serve, monkeypatch, late_s):
    """The console and the record have it before the first step."""
    monkeypatch.setattr("harness.live.visit.lateness_s", lambda: late_s)
    served = serve(protocol(0.5))
    browser = Browser(served)
    while not browser.drive(np.inf):
        pass
    _, events = steps_and_events(served)
    busy = events[events["event"] == "machine busy"]
    assert list(busy["step"]) == ([0] if late_s > 0.1 else [])
