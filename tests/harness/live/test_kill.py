"""A live study that is killed in mid-lap loses nothing that was acknowledged, and resumes."""

import json
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field

import numpy as np
import pyarrow.parquet as pq
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from harness.live.server import SILENT
from harness.running.sessions import world_of
from harness.session.borrowed import borrowed_models
from harness.session.replay import replay
from harness.session.study_run import StudyRun
from protocols.record.check import check_study
from protocols.record.header import read_header
from protocols.record.journal import journal_path, read_journal
from protocols.record.session import encode

PERIOD = 0.05


def protocol(on_interruption, seconds):
    """Return a study of one participant whose model learns in every step of a lap."""
    limited = {"limitation": {"right_turn_rad_s": 0.15}}
    taught = {**limited, "assistant": "demonstrator", "training": True}
    return {
        "schema": 1,
        "name": "killed",
        "title": "A session whose server is killed",
        "control_period_s": PERIOD,
        "cohort": {"participants": 1, "driver": {"use": "live"}, "respondent": None},
        "conditions": {"shown": taught, "helped": {**limited, "assistant": "model"}},
        "laps": [
            {"condition": "shown", "time_limit_s": seconds},
            {"condition": "helped", "time_limit_s": 1},
        ],
        "live": {"on_interruption": on_interruption},
    }


@dataclass
class Person:
    """Drives through a web socket, and remembers every picture that was shown."""

    person: str | None = None
    poses: dict[float, list[float]] = field(default_factory=dict)
    asked: list[dict] = field(default_factory=list)
    laps: int = 0

    def drive(self, link, until):
        """Drive until the session ends, or ``until(pictures so far)`` in the first lap."""
        while True:  # a link that was lost is tried again, as a page does
            try:
                return self.drive_once(link, until)
            except ConnectionClosed as lost:
                if lost.rcvd is None or lost.rcvd.code != SILENT:
                    raise

    def drive_once(self, link, until):
        """Drive as long as the connection lasts."""
        origin, _, token = link.partition("/p/")
        address = origin.replace("http", "ws") + "/ws"
        n = 0
        with connect(address, origin=origin, max_size=2**20, open_timeout=60) as browser:
            hello = {"type": "hello", "token": token, "person": self.person}
            browser.send(json.dumps(hello))
            while True:
                message = json.loads(browser.recv(timeout=60))
                kind = message["type"]
                if kind == "welcome":
                    self.person = message["person"]
                elif kind == "page":
                    self.asked.append(message)
                    self.laps += message["kind"] == "ready" and not message.get("resumed")
                    reply = {"type": "answer", "request": message["request"], "entered": {}}
                    browser.send(json.dumps(reply))
                elif kind == "ping":
                    browser.send(json.dumps({"type": "pong", "id": message["id"]}))
                elif kind == "picture":
                    n += 1
                    if self.laps == 1:
                        self.poses[message["t"]] = message["pose"]
                    stick = {"f": 0.9, "l": 0.4 * np.sin(message["t"])}
                    sent = 1000 * time.monotonic()
                    browser.send(json.dumps({"type": "input", "n": n, "sent": sent, **stick}))
                    if self.laps == 1 and until(len(self.poses)):
                        return False
                elif kind == "bye":
                    return True


class Server:
    """`lad-study live` in a process of its own."""

    def __init__(self, folder):
        self.folder, self.links = folder / "study", folder / "links.json"
        self.links.unlink(missing_ok=True)
        command = (
            "live", str(folder / "killed.yaml"), "--seed", "5", "--out", str(self.folder),
            "--port", "0", "--links", str(self.links), "--no-report",
        )  # fmt: skip
        self.process = subprocess.Popen(  # noqa: S603  # our own interpreter and code
            [sys.executable, "-c", "from harness.cli import main; main()", *command],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip

    @property
    def link(self):
        end = time.monotonic() + 120
        while not self.links.exists():
            assert self.process.poll() is None, self.process.stdout.read()
            assert time.monotonic() < end
            time.sleep(0.02)
        return json.loads(self.links.read_text())["participant"]

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.process.stdout.close()


def ticks(folder):
    """Return how many steps of the first lap a study's journal holds."""
    entries = read_journal(journal_path(folder, "P0001")).entries
    return sum("tick" in entry for entry in entries)


def killed_at(tmp_path, on_interruption, kills):
    """Run a session whose server is killed at these pictures; return its folder and driver."""
    seconds = (kills[-1] + 20) * PERIOD
    (tmp_path / "killed.yaml").write_text(json.dumps(protocol(on_interruption, seconds)))
    person = Person()
    for kill in kills:
        server = Server(tmp_path)
        try:
            assert not person.drive(server.link, lambda shown, at=kill: shown >= at)
        finally:
            server.kill()
        # A picture at time t acknowledges every step before t.
        assert ticks(server.folder) >= round(max(person.poses) / PERIOD)
    server = Server(tmp_path)
    try:
        assert person.drive(server.link, lambda _: False)
        assert server.process.wait(60) == 0
    finally:
        server.kill()
    return server.folder, person


def assert_replayed_bit_for_bit(folder):
    """Assert that the journal alone gives the record, byte for byte, learner included."""
    header = read_header(folder)
    run = StudyRun(header.study, header.seed, header.digest)
    world = world_of(run)
    journal = read_journal(journal_path(folder, "P0001"))
    again = encode(replay(journal, run, 1, world, borrowed_models(run, 1, world)), run.digest)
    session = folder / "sessions" / "P0001"
    assert {path.name: path.read_bytes() for path in session.iterdir()} == dict(again)
    assert (session / "model.npz").exists()


def test_a_killed_lap_resumes_where_it_was(tmp_path):
    """Kill -9 at a random tick: no acknowledged step is lost, and the record names it."""
    resumes(tmp_path, [int(np.random.default_rng(12).integers(15, 40))])


@pytest.mark.slow
def test_ten_kills_at_random_ticks(tmp_path):
    """Kill -9 of web server and session at ten random ticks of one lap."""
    resumes(tmp_path, sorted(int(k) for k in np.random.default_rng(10).integers(10, 400, 10)))


def resumes(tmp_path, kills):
    """Assert what holds after any number of kills in a lap that is to be resumed."""
    folder, person = killed_at(tmp_path, "resume", kills)
    assert check_study(folder) == ()
    laps = pq.read_table(folder / "laps.parquet")
    assert laps["end_reason"].to_pylist() == ["time_limit", "time_limit"]
    steps = pq.read_table(folder / "sessions" / "P0001" / "steps-0.parquet").to_pydict()
    recorded = dict(
        zip(
            np.round(steps["t_s"], 6),
            zip(steps["x_m"], steps["y_m"], steps["heading_rad"], strict=True),
            strict=True,
        )
    )
    assert len(recorded) == round(kills[-1] + 20)
    shown = {round(t, 6): tuple(pose) for t, pose in person.poses.items()}
    assert len(shown.keys() - recorded.keys()) <= 1  # the end of the last step starts none
    for t in shown.keys() & recorded.keys():  # what was shown before a kill is what is recorded
        assert shown[t] == recorded[t]
    events = pq.read_table(folder / "sessions" / "P0001" / "event_rows.parquet").to_pydict()
    assert events["event"].count("restarted") == len(kills)
    assert sum(bool(page.get("resumed")) for page in person.asked) == len(kills)
    assert_replayed_bit_for_bit(folder)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("on_interruption", "reasons"),
    [("exclude", ["disconnected", "time_limit"]),
     ("restart", ["disconnected", "time_limit", "time_limit"])],
)  # fmt: skip
def test_a_killed_lap_ends_as_declared(tmp_path, on_interruption, reasons):
    """Where a lap is not to be resumed it ends, and the record says so; or it is driven again."""
    folder, _ = killed_at(tmp_path, on_interruption, [25])
    assert check_study(folder) == ()
    laps = pq.read_table(folder / "laps.parquet")
    assert laps["end_reason"].to_pylist() == reasons
    assert laps["steps"].to_pylist()[0] >= 24
    events = pq.read_table(folder / "sessions" / "P0001" / "event_rows.parquet").to_pydict()
    assert events["event"].count("restarted") == 1
    assert_replayed_bit_for_bit(folder)
