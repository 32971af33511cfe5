"""What each role is sent, what is asked, and what stays when a participant stops."""

import contextlib
import json
import re
import sqlite3
import threading
import time
from importlib.resources import files

import pytest
from websockets.exceptions import ConnectionClosed

from harness.live.console import carry_out, shown
from harness.live.messages import Order
from protocols.record.reader import open_study

LIMITED = {"limitation": {"right_turn_rad_s": 0.15}}
PROTOCOL = {
    "schema": 1,
    "name": "pages",
    "title": "One lap of three living people",
    "cohort": {
        "participants": 2,
        "driver": {"use": "live"},
        "demonstrator": {"use": "live"},
        "respondent": {"use": "live"},
    },
    "consent": {"text": "# Taking part", "version": "7"},
    "conditions": {
        "secret-name": {**LIMITED, "assistant": "demonstrator", "training": True},
        "other-name": {**LIMITED, "assistant": "model"},
    },
    "laps": [
        {"condition": "secret-name", "time_limit_s": 1.5},
        {"condition": "other-name", "time_limit_s": 1.5},
    ],
    "live": {"withdrawal": "purge", "completion": {"code": "C-77"}, "shadow": True},
}


def with_live(**changes):
    """Return the protocol with other live settings."""
    return {**PROTOCOL, "live": {**PROTOCOL["live"], **changes}}


class Person:
    """A browser that agrees, answers and holds the stick forward, and keeps every frame."""

    def __init__(self, served, role, **hello):
        self.socket = served.open(role, **hello)
        self.frames, self.n = [], 0

    def next(self, seconds=60):
        """Return the next message, after doing what it asks for."""
        message = json.loads(self.socket.recv(timeout=seconds))
        self.frames.append(message)
        if message["type"] == "ping":
            self.say(type="pong", id=message["id"])
        elif message["type"] == "picture":
            self.n += 1
            self.say(type="input", n=self.n, sent=1000 * time.monotonic(), f=1, l=0, c=True)
        return message

    def until(self, wanted, seconds=120):
        """Go on until a message is wanted; answer every page before it."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            message = self.next()
            if wanted(message):
                return message
            if message["type"] == "page":
                self.answer(message, {"agreed": 1} if message["kind"] == "consent" else {})
        return pytest.fail("it did not come")

    def stay(self):
        """Go on in the background until the connection ends."""

        def go_on():
            with contextlib.suppress(ConnectionClosed, TimeoutError):
                while True:
                    self.next()

        threading.Thread(target=go_on, daemon=True).start()

    def answer(self, page, entered):
        """Answer a page."""
        self.say(type="answer", request=page["request"], entered=entered)

    def say(self, **message):
        """Send a message."""
        self.socket.send(json.dumps(message))


def is_page(kind):
    """Return the test for a page of a kind."""
    return lambda message: message["type"] == "page" and message["kind"] == kind


def is_picture(message):
    """Tell whether a message is a picture of a lap."""
    return message["type"] == "picture"


def is_bye(message):
    """Tell whether a message is the last one."""
    return message["type"] == "bye"


def driven(serve, protocol):
    """Drive a whole session; return the study, and what the three roles were sent."""
    served = serve(protocol)
    demonstrator = Person(served, "demonstrator")
    participant = Person(served, "participant", ids={"PROLIFIC_PID": "someone-7", "x": "y"})
    participant.until(is_picture)
    demonstrator.until(is_picture)
    demonstrator.stay()
    console = json.loads(json.dumps(shown(served.study, whole=True), default=float))
    bye = participant.until(is_bye)
    return served, participant, demonstrator, console, bye


@pytest.mark.parametrize("sees", [False, True])
def test_each_role_is_sent_what_it_may_know(serve, sees):
    """No condition, no helper, no p(h) for the participant; p(h) for a demonstrator if declared."""
    protocol = with_live(demonstrator_sees_p_help=sees, withdrawal="keep")
    served, participant, demonstrator, console, bye = driven(serve, protocol)
    for person, forbidden in (
        (participant, ("p_help", "variance", "-name", "demonstrator", "assistant", "ranges")),
        (demonstrator, ("variance", "-name", '"helped"', "someone-7", "P0001", "assistant")),
    ):
        sent = json.dumps(person.frames)
        assert [word for word in forbidden if word in sent] == []
    assert ("p_help" in json.dumps(demonstrator.frames)) is sees
    assert {"secret-name"} <= {session["condition"] for session in console["sessions"]}
    assert bye == {"type": "bye", "reason": "finished", "purged": False,
                   "completion": {"code": "C-77", "url": None}}  # fmt: skip
    served.wait((served.study.folder / "participants.parquet").exists)
    _shadow_did_not_drive(served.study.folder)
    _identities_lie_apart(served.study)


def _shadow_did_not_drive(folder):
    """Look at the model's lap: a clutch is recorded as what would be done, and does nothing."""
    study = open_study(folder)
    steps = study.steps("P0001", 1).to_pandas()
    assert (steps["h_would"] == 1).any()
    assert steps["h"].isna().all()
    assert set(steps["control"]) <= {"driver", "model"}


def _identities_lie_apart(study):
    """Look for a platform's id: in one file beside the study; other parameters are nowhere."""
    with contextlib.closing(sqlite3.connect(study.private / "identities.sqlite")) as database:
        assert database.execute("select * from ids").fetchall() == [
            ("P0001", "PROLIFIC_PID", "someone-7")
        ]
    assert not _found(study.folder, b"someone-7")


def _found(folder, word):
    """Return the files that hold some bytes, in their content or in their name."""
    found = []
    for path in folder.rglob("*"):
        with contextlib.suppress(FileNotFoundError):  # it is being deleted
            if path.is_file() and (word in path.read_bytes() or word.decode() in path.name):
                found.append(path)
    return found


def test_who_stops_with_a_promise_of_deletion_leaves_a_number(serve):
    """Every byte is gone from the directory and beside it; the tombstone with the number stays."""
    served = serve(PROTOCOL)
    participant = Person(served, "participant", ids={"PROLIFIC_PID": "someone-7"}, agent="Fox-7")
    Person(served, "demonstrator")
    participant.until(is_page("ready"))
    folder, private = served.study.folder, served.study.private
    assert _found(folder, b"Fox-7")
    assert _found(private, b"someone-7")
    (folder / "report").mkdir()
    (folder / "report" / "index.html").write_text("P0001 drove")
    participant.say(type="withdraw", reason="enough of this")
    bye = participant.until(is_bye)
    assert (bye["reason"], bye["purged"], bye["completion"]) == ("withdrew", True, None)
    served.wait(lambda: served.study.visits["P0001"].over and not _found(folder, b"Fox-7"))
    # The codebook has the number as an example; the list of allocations says whose slot is free.
    explained = {"codebook.json", "allocations.json"}
    served.wait(lambda: {p.name for p in _found(folder, b"P0001")} - explained == {"P0001.json"})
    assert not _found(private, b"someone-7")
    assert not _found(folder, b"enough of this")
    stone = json.loads((folder / "withdrawn" / "P0001.json").read_text())
    assert stone["participant"] == "P0001"
    assert served.study.next_participant() == "P0002"


def test_who_stops_with_data_kept_is_on_record(serve):
    """What was driven stays, and the record says that and why the participant left."""
    served = serve(with_live(withdrawal="keep"))
    participant = Person(served, "participant")
    Person(served, "demonstrator")
    participant.until(is_picture)
    participant.say(type="withdraw", reason="enough")
    assert participant.until(is_bye)["reason"] == "withdrew"
    served.wait((served.study.folder / "participants.parquet").exists)
    study = open_study(served.study.folder)
    assert study.laps["end_reason"].to_pylist() == ["withdrew"]
    assert study.laps["withdrawal"].to_pylist() == ["enough"]
    events = study.events.to_pylist()
    assert ("consent", "version 7: agreed") in {(e["event"], e["note"]) for e in events}


def test_a_machine_below_the_rule_is_refused(serve):
    """Declared as refused, a slow browser is told so, and nothing else follows."""
    rule = {"rule": "refuse", "min_frame_rate": 20}
    served = serve(with_live(machine_check=rule))
    participant = Person(served, "participant")
    participant.answer(participant.until(is_page("check")), {"frame_rate": 5})
    assert participant.until(is_bye)["reason"] == "unfit"


def test_the_console_begins_a_lap_and_tells_who_is_next(serve):
    """Start answers the page that waits for the participant; quota and order are shown."""
    served = serve(with_live(withdrawal="keep"))
    participant = Person(served, "participant")
    participant.until(is_page("ready"))
    before = shown(served.study, whole=True)["outlook"]
    assert before["next"] == {
        "participant": "P0002", "reason": "the next slot", "group": None,
        "laps": ["secret-name", "other-name"], "free": False,
    }  # fmt: skip
    order = "secret-name > other-name"
    assert before["quota"] == [
        {"group": None, "order": order, "planned": 2, "finished": 0, "under_way": 1}
    ]
    carry_out(served.study, Order(do="start", participant="P0001", text="ready now"))
    Person(served, "demonstrator")
    participant.until(is_picture)
    events = served.study.visits["P0001"].snapshot()["events"]
    assert ("start", "ready now") in {(e["event"], e["note"]) for e in events}


@pytest.mark.parametrize("allocation", ["concealed", "shown"])
def test_what_the_next_participant_gets_is_concealed_unless_the_protocol_shows_it(
    serve, allocation
):
    """Where orders differ, who enrols people must not know the next one."""
    plain = {"conditions": {"secret-name": {}, "other-name": {}}, "orders": {"use": "all"}}
    data = with_live(allocation=allocation) | plain
    news = shown(serve(data).study, whole=True)["outlook"]
    assert len(news["quota"]) == 2
    assert ("laps" in news["next"]) == (allocation == "shown")
    assert ("secret-name" in str(news["next"])) == (allocation == "shown")


NAMED = (
    "consent-agree", "consent-refuse", "check-continue", "demographics-submit",
    "instructions-continue", "lap-start", "questions-submit", "withdraw", "debrief-done", "lobby",
    "clutch", "lap-pause", "lap-resume", "lap-stop", "emergency-stop", "note-text", "note-save",
    "answer-${q.item}-${value}", "session-${name}",
)  # fmt: skip


def test_the_pages_have_the_names_that_others_test_by():
    """Every data-testid that is promised is in a script that ships."""
    folder = files("harness.live").joinpath("static")
    text = "".join(f.read_text() for f in folder.iterdir() if f.name.endswith(".js"))
    given = set(re.findall(r'test: [`"]([^`"]+)[`"]', text))
    given |= set(re.findall(r'button\("([^"]+)"', text))
    given |= set(re.findall(r'act\("[^"]+", "[^"]+", "([^"]+)"', text))
    assert [name for name in NAMED if name not in given] == []
