"""A live study served on loopback, and browsers made of a few lines."""

import asyncio
import contextlib
import json
import socket
import threading
import time

import pytest
from websockets.sync.client import connect

from harness.live.serve import web_server
from harness.live.study import LiveStudy
from harness.session.study_run import StudyRun
from protocols.load import resolve_study
from protocols.record.store import locked


class Served:
    """A live study, and what a browser needs to find it."""

    def __init__(self, study, port, release):
        self.study, self.port, self.release = study, port, release
        self.browsers = contextlib.ExitStack()
        self.origin = f"http://127.0.0.1:{port}"

    def link(self, role):
        return self.study.tokens.link(role)

    def open(self, role, origin=None, token=None, **hello):
        opening = connect(
            f"ws://127.0.0.1:{self.port}/ws", origin=origin or self.origin, max_size=2**20,
            open_timeout=120,
        )  # fmt: skip
        socket_ = self.browsers.enter_context(opening)
        first = {"type": "hello", "token": token or self.link(role), **hello}
        socket_.send(json.dumps(first))
        return socket_

    def wait(self, condition, seconds=60):
        until = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > until:
                pytest.fail("it did not happen in time")
            time.sleep(0.02)


@pytest.fixture
def serve(tmp_path):
    """Return a function that serves a protocol given as data."""
    running = []

    def start(data, seed=5, **settings):
        path = tmp_path / "live.yaml"
        path.write_text(json.dumps(data))
        run = StudyRun(resolve_study(str(path)), seed)
        folder = tmp_path / "study"
        hold = contextlib.ExitStack()
        hold.enter_context(locked(folder))
        study = LiveStudy(run, folder, **settings)
        listener = socket.create_server(("127.0.0.1", 0))
        port = listener.getsockname()[1]
        hosts = frozenset({f"127.0.0.1:{port}"})
        server = web_server(study, hosts, frozenset({f"http://127.0.0.1:{port}"}))
        thread = threading.Thread(
            target=lambda: asyncio.run(server.serve(sockets=[listener])), daemon=True
        )
        thread.start()
        served = Served(study, port, hold.close)
        running.append((server, thread, served, listener, hold))
        return served

    yield start
    for server, thread, served, listener, hold in running:
        served.browsers.close()
        for visit in served.study.visits.values():
            if not visit.over:
                visit.end("the test is over")
            visit.join(30)
        server.should_exit = True
        thread.join(30)
        listener.close()
        hold.close()
