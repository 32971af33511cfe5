"""The web server: pages in, sticks and answers in, pictures out. It decides nothing."""

import asyncio
import contextlib
import itertools
import json
from collections.abc import Callable, Mapping
from importlib.resources import files
from typing import Any

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from harness.live import messages
from harness.live.console import carry_out, shown
from harness.live.guard import REFUSED, Guard
from harness.live.limits import TokenBucket
from harness.live.mailbox import Mailbox
from harness.live.study import LiveStudy, seat_nonce
from harness.live.tokens import ROLES, Grant
from harness.live.visit import Visit
from protocols.course.drawing import SCRIPTS, course_picture, script
from protocols.live import LiveSettings

TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".txt": "text/plain; charset=utf-8",
}
PAGES = {"p": "participant.html", "d": "demonstrator.html", "x": "experimenter.html"}

RATE, BURST = 120.0, 240
"""Messages a connection may send in a second, and at once."""

HELLO_S, PING_S, CONSOLE_S = 10.0, 1.0, 0.2
"""How long a first message may take, how often round trips are measured and consoles fed, s."""

SILENT_S, TURN_S = 2.5, 0.25
"""A browser that does not even answer pings for so long is lost, though its socket is open; and
how often that is looked at, s. Time in which this process did not run is not counted."""

FIRST_PINGS, FIRST_PING_S = 9, 0.15
"""A new connection's round trip is measured so often, so quickly: the machine check needs it."""

CONSOLE_WHOLE = 5
"""Every so many times a console gets what changes slowly, too."""

REPLACED, FLOODED, SILENT = 4001, 4008, 4009
"""Reasons for which a socket is closed; the pages know them."""


def make_app(study: LiveStudy, hosts: frozenset[str], origins: frozenset[str]) -> Starlette:
    """Return the web application of a live study.

    Parameters
    ----------
    study
        What it serves.
    hosts
        Values of the Host header that are answered, with their ports.
    origins
        Values of the Origin header from which sockets are accepted.
    """
    server = _Server(study)
    routes = [
        Route("/", lambda _: PlainTextResponse("open one of the links that were printed")),
        Route("/static/{name:str}", server.static),
        Route("/{letter:str}/{token:str}", server.page),
        WebSocketRoute("/ws", server.socket),
    ]
    guard = Middleware(Guard, hosts=hosts, origins=origins)
    return Starlette(routes=routes, middleware=[guard])


class _Server:
    def __init__(self, study: LiveStudy) -> None:
        self._study = study
        resolved = study.run.study
        self._course = course_picture(resolved.course)
        self._courses = {name: course_picture(c) for name, c in resolved.group_courses.items()}
        self._static = {
            file.name: file.read_bytes()
            for file in files("harness.live").joinpath("static").iterdir()
            if file.is_file()
        } | {name: script(name).encode() for name in SCRIPTS}

    async def page(self, request: Request) -> Response:
        """Return a role's page; the page itself asks with its link's token."""
        letter, token = request.path_params["letter"], request.path_params["token"]
        grant = self._study.tokens.read(token)
        if letter not in PAGES or grant is None or ROLES[letter] != grant.role:
            return PlainTextResponse("this link is not valid", 404)
        return Response(self._static[PAGES[letter]], media_type=TYPES[".html"])

    async def static(self, request: Request) -> Response:
        """Return a file that ships, by its exact name."""
        name = request.path_params["name"]
        if name not in self._static:
            return PlainTextResponse("not found", 404)
        suffix = f".{name.rpartition('.')[2]}"
        return Response(self._static[name], media_type=TYPES.get(suffix, "text/plain"))

    async def socket(self, socket: WebSocket) -> None:
        """Serve one browser until it goes, misbehaves, or another takes its seat."""
        await socket.accept()
        hello = await self._hello(socket)
        grant = None if hello is None else self._study.tokens.read(hello.token)
        if hello is None or grant is None:
            await _close(socket, REFUSED)
            return
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            if grant.role == "participant":
                await self._participant(socket, hello, grant)
            elif grant.role == "demonstrator":
                await self._demonstrator(socket)
            else:
                await self._experimenter(socket)

    async def _hello(self, socket: WebSocket) -> messages.Hello | None:
        try:
            content = await asyncio.wait_for(socket.receive_text(), HELLO_S)
        except (TimeoutError, WebSocketDisconnect, KeyError):
            return None
        message = messages.decode(content)
        return message if isinstance(message, messages.Hello) else None

    async def _participant(self, socket: WebSocket, hello: messages.Hello, grant: Grant) -> None:
        visit = self._visit_of(hello, grant)
        if visit is None:
            await socket.send_text(json.dumps({"type": "full"}))
            await _close(socket, 1000)
            return
        person = self._study.tokens.issue("participant", visit.name, nonce=seat_nonce(visit.name))
        protocol = self._study.run.study.protocol
        visit.event(
            "program", "browser", f"{hello.agent}; {hello.width} x {hello.height}; {hello.view}"
        )
        welcome = {
            "type": "welcome",
            "role": "participant",
            "person": person,
            "course": self._course_of(visit),
            "live": _for_participant(protocol.live.model_dump(mode="json")),
            "period_s": protocol.control_period_s,
        }
        await socket.send_text(json.dumps(welcome))
        await self._serve_seat(
            socket, visit.participant, lambda m: _from_participant(visit, m), visit
        )

    def _course_of(self, visit: Visit) -> dict[str, object]:
        """Return the picture of the course that a session's participant drives."""
        return self._courses.get(visit.group or "", self._course)

    def _visit_of(self, hello: messages.Hello, grant: Grant) -> Visit | None:
        """Return the session that a browser belongs to: its own, or the next one."""
        mine = self._study.tokens.read(hello.person) if hello.person else None
        name = grant.person or (mine.person if mine and mine.role == "participant" else None)
        if name is not None:
            return self._study.visits.get(name)
        left = [v for v in self._study.visits.values() if v.abandoned and not v.over]
        for visit in left:  # resumed after a restart, and its browser did not come back
            if not visit.participant.connected:
                return visit
        enrolled = self._study.enrol()
        if enrolled is not None:
            self._study.identify(enrolled.name, hello.ids)
        return enrolled

    async def _demonstrator(self, socket: WebSocket) -> None:
        protocol = self._study.run.study.protocol
        welcome = {
            "type": "welcome",
            "role": "demonstrator",
            "course": self._course,
            "live": _for_demonstrator(protocol.live),
            "period_s": protocol.control_period_s,
        }
        await socket.send_text(json.dumps(welcome))
        gone = asyncio.Event()
        sticks: dict[str, Mailbox] = {}
        course = self._course
        reading = asyncio.create_task(
            self._read(socket, lambda m: _to_seat(sticks.get("seat"), m), gone)
        )
        try:
            while not gone.is_set():
                visit = self._in_need()
                if visit is None:
                    await socket.send_text(json.dumps({"type": "lobby"}))
                    await _either(gone, 0.3)
                    continue
                if self._course_of(visit) is not course:
                    course = self._course_of(visit)
                    await socket.send_text(json.dumps({"type": "course", "course": course}))
                sticks["seat"] = visit.demonstrator
                await self._feed(socket, visit.demonstrator, gone, visit.wants_demonstrator)
                sticks.pop("seat", None)
        finally:
            reading.cancel()

    def _in_need(self) -> Visit | None:
        """Return a session that waits for a demonstrator and has none."""
        for visit in self._study.visits.values():
            if not visit.over and visit.needs_demonstrator and not visit.demonstrator.connected:
                return visit
        return None

    async def _experimenter(self, socket: WebSocket) -> None:
        welcome = {
            "type": "welcome",
            "role": "experimenter",
            "course": self._course,
            "courses": self._courses,
        }
        await socket.send_text(json.dumps(welcome))
        gone = asyncio.Event()

        def obey(message: messages.Received) -> None:
            if isinstance(message, messages.Order):
                carry_out(self._study, message)

        reading = asyncio.create_task(self._read(socket, obey, gone))
        try:
            for n in itertools.count():
                if gone.is_set():
                    break
                news = shown(self._study, whole=n % CONSOLE_WHOLE == 0)
                await socket.send_text(json.dumps(news, default=float))
                await _either(gone, CONSOLE_S)
        finally:
            reading.cancel()

    async def _serve_seat(
        self,
        socket: WebSocket,
        seat: Mailbox,
        take: Callable[[messages.Received], None],
        visit: Visit,
    ) -> None:
        gone = asyncio.Event()
        reading = asyncio.create_task(self._read(socket, take, gone))
        try:
            await self._feed(socket, seat, gone, lambda: not visit.over)
            if visit.over and not gone.is_set():
                await socket.send_text(json.dumps(self._farewell(visit)))
                await _close(socket, 1000)
        finally:
            reading.cancel()

    def _farewell(self, visit: Visit) -> dict[str, Any]:
        """Return the last message to a participant: only who went through gets a code or link."""
        completion = self._study.run.study.protocol.live.completion
        if visit.farewell != "finished":
            completion = None
        return {
            "type": "bye",
            "reason": visit.farewell,
            "purged": visit.farewell == "withdrew" and self._study.purges,
            "completion": None if completion is None else completion.model_dump(mode="json"),
        }

    async def _feed(
        self, socket: WebSocket, seat: Mailbox, gone: asyncio.Event, wanted: Callable[[], bool]
    ) -> None:
        """Give a seat to a connection, and send what is shown there, as long as it is wanted."""
        loop, news = asyncio.get_running_loop(), asyncio.Event()

        def wake() -> None:
            with contextlib.suppress(RuntimeError):  # the loop may have closed
                loop.call_soon_threadsafe(news.set)

        number = seat.connect(wake)
        page = picture = pings = 0
        pinged = looked = loop.time()
        silent = 0.0
        try:
            while not gone.is_set() and wanted():
                if not seat.has_seat(number):
                    await _close(socket, REPLACED)
                    gone.set()
                    return
                now = loop.time()
                silent = min(silent + min(now - looked, 2 * TURN_S), seat.silent_s)
                looked = now
                if silent > SILENT_S:
                    seat.disconnect(number)  # first: closing waits for the other side
                    await _close(socket, SILENT)
                    gone.set()
                    return
                fresh, page, picture = seat.to_send(page, picture)
                for message in fresh:
                    await socket.send_text(json.dumps(message, default=float))
                if loop.time() - pinged > (PING_S if pings >= FIRST_PINGS else FIRST_PING_S):
                    pinged, pings = loop.time(), pings + 1
                    await socket.send_text(json.dumps(seat.ping(pings)))
                await _either(news, TURN_S if pings >= FIRST_PINGS else FIRST_PING_S)
                news.clear()
        finally:
            seat.disconnect(number)

    async def _read(
        self, socket: WebSocket, take: Callable[[messages.Received], None], gone: asyncio.Event
    ) -> None:
        """Take a connection's messages until it goes; too many, or senseless ones, end it."""
        bucket = TokenBucket(RATE, BURST)
        with contextlib.suppress(WebSocketDisconnect, RuntimeError, KeyError):
            while True:
                content = await socket.receive_text()
                message = messages.decode(content)
                if not bucket.take() or message is None:
                    await _close(socket, FLOODED if message is not None else REFUSED)
                    break
                take(message)
        gone.set()


def _from_participant(visit: Visit, message: messages.Received) -> None:
    if isinstance(message, messages.Withdraw):
        visit.withdraw("participant", message.reason)
    elif isinstance(message, messages.Comfortable):
        visit.comfortable()
    else:
        _to_seat(visit.participant, message)


def _to_seat(seat: Mailbox | None, message: messages.Received) -> None:
    if seat is None:
        return
    if isinstance(message, messages.Stick):
        seat.put_stick(message)
    elif isinstance(message, messages.Pong):
        seat.pong(message.id)
    elif isinstance(message, messages.Answered):
        seat.put_answer(message.request, message.entered)


def _for_participant(live: Mapping[str, Any]) -> dict[str, Any]:
    """Return what of the live settings a participant's page needs."""
    wanted = ("view", "show_lap_time", "machine_check", "instructions", "questions", "withdrawal")
    return {name: live[name] for name in wanted}


def _for_demonstrator(live: LiveSettings) -> dict[str, Any]:
    return {"clutch": live.clutch, "view": live.demonstrator_view, "shadow": live.shadow}


async def _either(event: asyncio.Event, seconds: float) -> None:
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(event.wait(), seconds)


async def _close(socket: WebSocket, code: int) -> None:
    with contextlib.suppress(RuntimeError, WebSocketDisconnect):
        await socket.close(code)
