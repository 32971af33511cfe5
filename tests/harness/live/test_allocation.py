"""Orders of living people are decided at enrolment; the place of one who left is given again."""

import json
import shutil

import pyarrow.parquet as pq
import pytest

from harness.running.recovery import recover_sessions
from protocols.order import in_words, laps_of
from protocols.record.check import check_study
from protocols.record.enrolment import read_allocations

PROTOCOL = {
    "schema": 1,
    "name": "allocated",
    "title": "Two laps in either order",
    "cohort": {
        "participants": 2,
        "driver": {"use": "live"},
        "demonstrator": None,
        "respondent": None,
    },
    "consent": {"text": "You drive.", "version": "1"},
    "conditions": {"free": {}, "limited": {"limitation": {"right_turn_rad_s": 0.15}}},
    "laps": [
        {"condition": "free", "time_limit_s": 1},
        {"condition": "limited", "time_limit_s": 1},
    ],
    "orders": {"use": "random"},
}


def take_part(served, leave=None):
    """Go through a session as a browser would; refuse, or leave in the first lap; who it was."""
    browser = served.open("participant")
    name = None
    while True:
        message = json.loads(browser.recv(timeout=60))
        if message["type"] == "welcome":
            name = served.study.tokens.read(message["person"]).person
        elif message["type"] == "page":
            agreed = int(leave != "refuse")
            entered = {"agreed": agreed} if message["kind"] == "consent" else {}
            answer = {"type": "answer", "request": message["request"], "entered": entered}
            browser.send(json.dumps(answer))
        elif message["type"] == "ping":
            browser.send(json.dumps({"type": "pong", "id": message["id"]}))
        elif message["type"] == "picture":
            if leave == "withdraw":
                browser.send(json.dumps({"type": "withdraw", "reason": "enough"}))
            stick = {"type": "input", "n": message["n"], "sent": 0, "f": 0.5, "l": 0.0}
            browser.send(json.dumps(stick))
        elif message["type"] in {"bye", "full"}:
            browser.close()
            return name


@pytest.mark.parametrize("leave", ["withdraw", "refuse"])
def test_the_place_of_one_who_left_is_given_again(serve, leave):
    """Orders balance over usable sessions; why each was given is in the record and the console."""
    served = serve(PROTOCOL, lockstep=True)
    study, folder = served.study, served.study.folder
    assert read_allocations(folder) == {}  # nothing is decided, so nothing can be known, before
    assert take_part(served, leave) == "P0001"
    served.wait(lambda: not study.progress().active)
    assert not study.over
    assert [take_part(served) for _ in range(3)] == ["P0002", "P0003", None]  # then it is full
    served.wait(lambda: study.over)
    given = {name: (a.slot, a.reason) for name, a in read_allocations(folder).items()}
    assert given == {
        "P0001": (1, "the next slot"),
        "P0002": (1, "given again: P0001 was withdrawn"),
        "P0003": (2, "the next slot"),
    }
    assert check_study(folder) == ()
    people = pq.read_table(folder / "participants.parquet").to_pydict()
    for name, order in zip(people["participant"], people["order"], strict=True):
        assert order == in_words(laps_of(study.run.study.protocol, given[name][0], study.run.seed))
    session = folder / "sessions" / "P0003"
    events = pq.read_table(session / "event_rows.parquet").to_pydict()
    assert "slot 2: the next slot" in events["note"]
    files = {path.name: path.read_bytes() for path in session.iterdir()}
    shutil.rmtree(session)
    served.release()
    assert recover_sessions(folder).recovered == ("P0003",)
    assert {path.name: path.read_bytes() for path in session.iterdir()} == files
