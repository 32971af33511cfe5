"""Groups of living people that drive courses of their own."""

import json
import shutil
import threading
import time

import pytest

from harness.live.console import shown
from harness.running.recovery import recover_sessions
from protocols.course.drawing import course_picture
from protocols.record.check import check_study
from protocols.record.reader import open_study

PROTOCOL = {
    "schema": 1,
    "name": "two courses",
    "title": "One lap each on another course",
    "cohort": {
        "participants": 2,
        "driver": {"use": "live"},
        "demonstrator": {"use": "live"},
        "respondent": None,
    },
    "conditions": {"drive": {}},
    "laps": [{"condition": "drive", "time_limit_s": 1}],
    "groups": {
        "here": {},
        "there": {
            "course": "ward-corridor",
            "conditions": {"drive": {"assistant": "demonstrator"}},
        },
    },
}


def take_part(served, role):
    """Do what a role is asked, and drive ahead; return every message to it."""
    browser, got = served.open(role), []
    while True:
        message = json.loads(browser.recv(timeout=60))
        got.append(message)
        if message["type"] == "page":
            answer = {"type": "answer", "request": message["request"], "entered": {}}
            browser.send(json.dumps(answer))
        elif message["type"] == "ping":
            browser.send(json.dumps({"type": "pong", "id": message["id"]}))
        elif message["type"] == "picture":
            sent = 1000 * time.monotonic()
            stick = {"type": "input", "n": len(got), "sent": sent, "f": 1, "l": 0, "c": True}
            browser.send(json.dumps(stick))
        ended = role == "participant" and message["type"] == "bye"
        if ended or (role == "demonstrator" and served.study.over and message["type"] == "lobby"):
            browser.close()
            return got


def pictures(messages):
    """Return the pictures of laps among messages."""
    return [message for message in messages if message["type"] == "picture"]


@pytest.fixture
def driven(serve):
    """Have two people drive, and a demonstrator there; who was sent what, by group."""
    served = serve(PROTOCOL)
    seen = []
    watching = threading.Thread(
        target=lambda: seen.extend(take_part(served, "demonstrator")), daemon=True
    )
    watching.start()
    sent = {}
    for _ in range(2):
        got = take_part(served, "participant")
        sent[max(served.study.visits.items())[1].group] = got
        served.wait(lambda: not served.study.progress().active)
    watching.join(60)
    return served, sent, seen


def test_each_group_drives_and_sees_its_own_course(driven):
    """World, pictures of all three roles, and the record are of the course of one's group."""
    served, sent, seen = driven
    resolved = served.study.run.study
    courses = {"here": resolved.course, "there": resolved.group_courses["there"]}
    drawn = {name: json.loads(json.dumps(course_picture(c))) for name, c in courses.items()}
    for group, got in sent.items():
        (welcome,) = [message for message in got if message["type"] == "welcome"]
        assert welcome["course"] == drawn[group]
        start, (x, y, *_) = courses[group].start, pictures(got)[0]["pose"]
        assert (x, y) == pytest.approx((start.x, start.y), abs=0.3)
    assert [m["course"] for m in seen if "course" in m] == [drawn["here"], drawn["there"]]
    assert pictures(seen)  # of the group whose laps a demonstrator helps in, and of no other
    last = next(i for i, m in enumerate(seen) if m["type"] == "course")
    assert pictures(seen[:last]) == []
    console = served.open("experimenter")
    welcome = json.loads(console.recv(timeout=60))
    assert (welcome["course"], welcome["courses"]) == (drawn["here"], {"there": drawn["there"]})
    groups = {s["participant"]: s["group"] for s in shown(served.study, whole=False)["sessions"]}
    study = open_study(served.study.folder)
    assert check_study(served.study.folder) == ()
    assert sorted(groups.values()) == ["here", "there"]
    for who, group in groups.items():
        assert study.course_of(who) == courses[group]
        driver = study.steps(who, 0).to_pandas().iloc[0]
        start = courses[group].start
        assert (driver["x_m"], driver["y_m"]) == pytest.approx((start.x, start.y), abs=0.3)


def test_a_lost_session_is_made_again_on_its_groups_course(driven):
    """Recovery from the journal gives the bytes of both groups' sessions."""
    served, _, _ = driven
    sessions = served.study.folder / "sessions"
    before = {p.relative_to(sessions): p.read_bytes() for p in sessions.rglob("*.*")}
    assert before
    shutil.rmtree(sessions)
    served.release()
    assert recover_sessions(served.study.folder).recovered == ("P0001", "P0002")
    assert {p.relative_to(sessions): p.read_bytes() for p in sessions.rglob("*.*")} == before
