"""What a stranger, a hostile page or a broken browser can do to a live study: nothing."""

import contextlib
import json
import time

import httpx
import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from harness.live import messages
from harness.live.tokens import Tokens

PROTOCOL = {
    "schema": 1,
    "name": "safety",
    "title": "One lap",
    "cohort": {"participants": 2, "driver": {"use": "live"}, "respondent": None},
    "conditions": {"free": {}},
    "laps": [{"condition": "free", "time_limit_s": 30}],
}


@pytest.fixture
def served(serve):
    """Return a live study on loopback."""
    return serve(PROTOCOL)


def received(browser, kind, seconds=20):
    """Return the next message of a kind."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        message = json.loads(browser.recv(timeout=seconds))
        if message["type"] == kind:
            return message
        if message["type"] == "ping":
            browser.send(json.dumps({"type": "pong", "id": message["id"]}))
    return pytest.fail(f"no {kind}")


def closed_with(browser, seconds=20):
    """Return the code with which the server closes a connection."""
    try:
        while True:
            browser.recv(timeout=seconds)
    except ConnectionClosed as closing:
        return closing.rcvd.code if closing.rcvd else None


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1"])
def test_a_foreign_origin_gets_no_socket(served, origin):
    """It is refused before the socket is accepted."""
    with pytest.raises(InvalidStatus) as refused:
        served.open("participant", origin=origin)
    assert refused.value.response.status_code == 403


def test_another_host_name_is_not_answered(served):
    """A name that an attacker points here (DNS rebinding) gets nothing."""
    answer = httpx.get(f"{served.origin}/", headers={"Host": "evil.example"}, timeout=20)
    assert answer.status_code == 400


def fetched(served, path):
    """Return status, headers and content of a page."""
    answer = httpx.get(f"{served.origin}{path}", timeout=20)
    return answer.status_code, answer.headers, answer.content


@pytest.mark.parametrize(
    "path",
    [
        "/p/forged", "/static/", "/static/../server.py", "/static/%2e%2e/server.py",
        "/static/..%2fserver.py", "/x/", "/studies", "/static",
    ],
)  # fmt: skip
def test_nothing_else_is_served(served, path):
    """No path leads out of the files that ship, and no folder is listed."""
    assert fetched(served, path)[0] == 404


def test_a_link_opens_its_role_only(served):
    """A participant's link does not open the console, and a page has a strict policy."""
    token = served.link("participant")
    status, headers, page = fetched(served, f"/p/{token}")
    assert status == 200
    assert token.encode() not in page
    assert "script-src 'self'" in headers["content-security-policy"]
    assert "unsafe-inline" not in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"
    for other in ("d", "x"):
        assert fetched(served, f"/{other}/{token}")[0] == 404


@pytest.mark.parametrize(
    "forge",
    [
        lambda token: token[:-1] + ("A" if token[-1] != "A" else "B"),
        lambda token: "x" + token[1:],
        lambda _: Tokens(b"another secret of 32 bytes......").issue("experimenter"),
        lambda _: "",
        lambda _: "....",
        lambda token: token.replace("link", "l\u00efnk"),
    ],
)
def test_a_forged_role_is_refused(served, forge):
    """A changed letter, another secret, or nothing: the socket is closed at once."""
    browser = served.open("participant", token=forge(served.link("participant")) or "-")
    assert closed_with(browser) == 4003


def test_a_revoked_link_is_refused(served):
    """Every copy of it stops working."""
    token = served.link("experimenter")
    served.study.revoke(served.study.tokens.read(token).nonce)
    assert closed_with(served.open("experimenter", token=token)) == 4003


def test_a_replayed_token_moves_nothing_after_its_session(serve):
    """Who kept a participant's own token, and says hello with it again, gets a goodbye only."""
    served = serve({**PROTOCOL, "laps": [{"condition": "free", "time_limit_s": 0.2}]})
    browser = served.open("participant")
    person = received(browser, "welcome")["person"]
    for _ in range(3):
        page = received(browser, "page")
        browser.send(json.dumps({"type": "answer", "request": page["request"], "entered": {}}))
    received(browser, "bye")
    for token in (person, served.link("participant")):
        replayed = served.open("participant", token=token, person=person)
        assert received(replayed, "welcome")["role"] == "participant"
        received(replayed, "bye")
        assert closed_with(replayed) == 1000
    assert list(served.study.visits) == ["P0001"]
    assert served.study.visits["P0001"].over
    for letter in ("d", "x"):  # and it opens no other role
        assert fetched(served, f"/{letter}/{person}")[0] == 404


def test_a_participant_cannot_order(served):
    """What only the console may do is ignored from another role's socket."""
    browser = served.open("participant")
    received(browser, "page")
    browser.send(json.dumps({"type": "order", "do": "end", "participant": "P0001"}))
    time.sleep(0.3)
    assert not served.study.visits["P0001"].over
    browser.close()


def test_a_participants_frames_hold_nothing_they_must_not_know(served):
    """No p(h), no condition's name, no helper's identity, no laser, no clearance."""
    browser = served.open("participant")
    welcome = received(browser, "welcome")
    assert "free" not in json.dumps(welcome)
    for _ in range(3):
        page = received(browser, "page")
        assert "condition" not in json.dumps(page)
        browser.send(json.dumps({"type": "answer", "request": page["request"], "entered": {}}))
    picture = received(browser, "picture")
    assert set(picture) == {
        "type", "n", "t", "pose", "velocity", "gates", "helped", "contact", "practice"
    }  # fmt: skip
    browser.close()


def test_an_oversized_message_closes_the_socket(served):
    """Long before it fills the memory."""
    browser = served.open("participant")
    received(browser, "page")
    browser.send("x" * 100_000)
    assert closed_with(browser) in {1009, None}


def test_a_flood_closes_the_socket(served):
    """120 messages a second are enough for anyone; the session goes on."""
    browser = served.open("participant")
    page = received(browser, "page")
    with contextlib.suppress(ConnectionClosed):
        for n in range(3000):
            browser.send(json.dumps({"type": "input", "n": n, "sent": n, "f": 0, "l": 0}))
    assert closed_with(browser) in {4008, None}
    again = served.open("participant")
    assert not served.study.visits["P0001"].over
    again.close()
    assert page["kind"] == "check"


def test_the_newest_connection_has_the_seat(served):
    """A second tab takes over; the first one is told."""
    first = served.open("participant")
    person = received(first, "welcome")["person"]
    received(first, "page")
    second = served.open("participant", person=person)
    assert received(second, "page")["kind"] == "check"
    assert closed_with(first) == 4001
    assert list(served.study.visits) == ["P0001"]
    second.close()


@pytest.mark.parametrize(
    "bad",
    [
        b"", b"null", b"[]", b"{}", b'{"type":"input"}', b'{"type":"nonsense"}',
        b'{"type":"input","n":1,"sent":0,"f":NaN,"l":0}',
        b'{"type":"input","n":1,"sent":0,"f":1e999,"l":0}',
        b'{"type":"input","n":1,"sent":0,"f":1.01,"l":0}',
        b'{"type":"input","n":-1,"sent":0,"f":0,"l":0}',
        b'{"type":"input","n":1,"sent":0,"f":0,"l":0,"pose":[0,0,0]}',
        b'{"type":"answer","request":1,"entered":{"a":1e999}}',
        b'{"type":"answer","request":1,"entered":{"a":[[[[]]]]}}',
        b"[" * 20_000, b'{"type":"hello","token":' + b'"' + b"x" * 400 + b'"}', b"\xff\xfe\x00",
    ],
)  # fmt: skip
def test_what_is_no_message_is_none(bad):
    """Missing, unknown, out of range, not finite, nested, too long: refused in one place."""
    assert messages.decode(bad) is None


def malformed(count):
    """Yield so many messages with a few bytes changed, removed or put in."""
    rng = np.random.default_rng(10_000)
    whole = [
        b'{"type":"input","n":12,"sent":123.5,"f":0.5,"l":-0.25,"c":true,"dev":"touch"}',
        b'{"type":"answer","request":3,"entered":{"driving-assistance.Q1":4,"x":null}}',
        b'{"type":"order","do":"pause","participant":"P0001","text":"now"}',
        b'{"type":"hello","token":"p..x.y","ids":{"PROLIFIC_PID":"1"},"width":1280}',
    ]
    for _ in range(count):
        content = bytearray(whole[rng.integers(len(whole))])
        for _ in range(rng.integers(1, 6)):
            place = rng.integers(len(content))
            kind = rng.integers(3)
            if kind == 0:
                content[place] = rng.integers(256)
            elif kind == 1:
                del content[place : place + rng.integers(1, 9)]
            else:
                content[place:place] = bytes(rng.integers(32, 127, size=rng.integers(1, 9)))
            content = content or bytearray(b" ")
        yield bytes(content)


def test_ten_thousand_malformed_messages_decode_to_nothing_or_to_a_message():
    """Whatever bytes come, decoding gives a message of ours or none, and raises nothing."""
    kept = sum(messages.decode(content) is not None for content in malformed(10_000))
    assert kept < 9000


def sent_to(served, person, contents):
    """Send messages one after the other; after each senseless one, open another socket."""
    browser, refused = served.open("participant", person=person), 0
    for content in contents:
        text = content.decode("latin-1")
        browser.send(text)
        if messages.decode(text) is None:
            assert closed_with(browser) == 4003
            browser, refused = served.open("participant", person=person), refused + 1
    browser.close()
    return refused


@pytest.mark.parametrize("count", [100, pytest.param(10_000, marks=pytest.mark.slow)])
def test_malformed_messages_through_sockets_leave_the_session_alive(served, count):
    """Every one is read; a senseless one closes its socket, and the session goes on."""
    person = received(served.open("participant"), "welcome")["person"]
    assert sent_to(served, person, malformed(count)) > count / 10
    received(served.open("participant", person=person), "page")
    assert list(served.study.visits) == ["P0001"]
    assert not served.study.visits["P0001"].over


def test_malformed_messages_leave_the_session_alive(served):
    """Each senseless message ends its connection, and nothing else."""
    browser = served.open("participant")
    person = received(browser, "welcome")["person"]
    for bad in ("{", '{"type":"input"}', '{"type":"hello"}', "[]"):
        received(browser, "page")
        browser.send(bad)
        assert closed_with(browser) == 4003
        browser = served.open("participant", person=person)
    assert received(browser, "page")["kind"] == "check"
    assert not served.study.visits["P0001"].over
