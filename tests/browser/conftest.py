"""A real browser, for what only a browser can tell: skipped in one line where there is none."""

import json
import math
import shutil
import subprocess
import sys
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files

import pytest

from harness.live.guard import HEADERS
from harness.live.server import PAGES, TYPES
from protocols.course.centreline import Centreline
from protocols.course.drawing import SCRIPTS, course_picture, script
from protocols.live import LiveSettings
from protocols.load import load_course

ARGUMENTS = (
    "--no-sandbox",  # in a container the tests run as root
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-gpu",
    "--disable-quic",
)


@pytest.fixture(scope="module")
def browser():
    """Return Chromium, driven by Playwright; it ends with the module's tests."""
    playwright = pytest.importorskip("playwright.sync_api", reason="no browser: install playwright")
    path = shutil.which("chromium") or shutil.which("google-chrome")
    if path is None:
        pytest.skip("no browser: install Debian's chromium (apt-get install chromium)")
    with playwright.sync_playwright() as play:
        chromium = play.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield chromium
        chromium.close()


@pytest.fixture
def visit(browser):
    """Return the function that opens an address in a tab of its own, and returns the tab.

    The tab's ``said`` collects what the page logs, its ``errors`` what its scripts raise, its
    ``asked`` the addresses it asks for, and ``failed`` those that it did not get, with the reason.
    """
    contexts = []

    def open_page(address, before=None):
        context = browser.new_context()
        contexts.append(context)
        page = context.new_page()
        page.said, page.errors, page.asked, page.failed = [], [], [], {}
        page.on("console", lambda message: page.said.append(message.text))
        page.on("pageerror", lambda error: page.errors.append(str(error)))
        page.on("request", lambda request: page.asked.append(request.url))
        page.on("requestfailed", lambda request: page.failed.update({request.url: request.failure}))
        if before is not None:
            page.add_init_script(before)
        page.goto(str(address))
        return page

    yield open_page
    for context in contexts:
        context.close()


AHEAD_M = 0.8
TURN_RAD, STOP_RAD = 0.10, 0.75


class Steering:
    """Holds the arrow keys of a page so that the chair follows the course's centreline.

    Parameters
    ----------
    tab
        The participant's page, with a lap on it.
    course
        What is driven.
    """

    def __init__(self, tab, course):
        self.tab, self.line = tab, Centreline(course)
        self.held, self.arc = set(), 0.0

    def pose(self):
        """Return where the page shows the chair; None before the first picture."""
        shown = self.tab.evaluate("document.body.dataset.pose || 'null'")
        return json.loads(shown)

    def step(self):
        """Look once, and press and release what is needed; return the chair's section."""
        pose = self.pose()
        if pose is None:
            return None
        x, y, heading = pose
        self.arc, _ = self.line.locate(x, y, self.arc)
        goal = self.line.point(min(self.arc + AHEAD_M, self.line.length))
        bearing = math.atan2(goal.y - y, goal.x - x) - heading
        error = math.atan2(math.sin(bearing), math.cos(bearing))
        wanted = set()
        if abs(error) < STOP_RAD:
            wanted.add("ArrowUp")
        if error > TURN_RAD:
            wanted.add("ArrowLeft")
        if error < -TURN_RAD:
            wanted.add("ArrowRight")
        for key in self.held - wanted:
            self.tab.keyboard.up(key)
        for key in wanted - self.held:
            self.tab.keyboard.down(key)
        self.held = wanted
        return self.line.section(self.arc)

    def release(self):
        """Let go of every key."""
        for key in self.held:
            self.tab.keyboard.up(key)
        self.held = set()


@pytest.fixture
def steering():
    """Return the class that holds a page's keys so that the chair follows a course."""
    return Steering


@pytest.fixture
def until():
    """Return a function that waits for something to become true.

    A page's policy allows no code of ours to wait inside it.
    """

    def wait(condition, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end
            time.sleep(0.1)

    return wait


@pytest.fixture
def serve_live(tmp_path, until):
    """Return a function that serves a protocol, given as data, by the command line.

    It returns the links, the study's folder and the server's process.
    """
    servers = []

    def serve(data, *more):
        (tmp_path / "live.yaml").write_text(json.dumps(data))
        links, folder = tmp_path / "links.json", tmp_path / "study"
        command = (
            "live", str(tmp_path / "live.yaml"), "--out", str(folder), "--port", "0",
            "--links", str(links), *more,
        )  # fmt: skip
        with (tmp_path / "said").open("w") as said:
            server = subprocess.Popen(  # noqa: S603  # our own interpreter and code
                [sys.executable, "-c", "from harness.cli import main; main()", *command],
                stdout=said, stderr=said,
            )  # fmt: skip
        servers.append(server)
        until(lambda: links.exists() or server.poll() is not None, 300)
        assert server.poll() is None, (tmp_path / "said").read_text()
        return json.loads(links.read_text()), folder, server

    yield serve
    for server in servers:
        server.kill()
        server.wait()


LETTERS = {page.removesuffix(".html"): letter for letter, page in PAGES.items()}
COURSE = load_course("lab-office")


class _Files(BaseHTTPRequestHandler):
    """Gives the pages and scripts that ship, with the headers of the real server."""

    def do_GET(self):
        name = self.path.partition("?")[0].rpartition("/")[2]
        letter = self.path.split("/")[1]
        name = PAGES.get(letter, name)
        path = files("harness.live").joinpath("static", name)
        if name not in SCRIPTS and not path.is_file():
            self.send_error(404)
            return
        content = script(name).encode() if name in SCRIPTS else path.read_bytes()
        self.send_response(200)
        for header, value in HEADERS:
            self.send_header(header, value)
        self.send_header("content-type", TYPES[f".{name.rpartition('.')[2]}"])
        self.send_header("content-length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_):
        """Say nothing."""


class Served:
    """The files, on loopback, until it is closed."""

    def __init__(self):
        self._server = ThreadingHTTPServer(("127.0.0.1", 0), _Files)
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        self.origin = f"http://localhost:{self._server.server_port}"

    def close(self):
        """Stop serving."""
        self._server.shutdown()
        self._server.server_close()


class Staged:
    """A role's page in a tab, and the test in the server's place.

    Parameters
    ----------
    context
        A context of the browser.
    origin
        Where the files are.
    role
        Whose page it is.
    live
        The live settings, as a protocol has them.
    """

    def __init__(self, context, origin, role, **live):
        self.tab, self.received, self.errors = context.new_page(), [], []
        self.tab.set_default_timeout(120_000)
        self.tab.on("pageerror", lambda error: self.errors.append(str(error)))
        self.tab.on("console", self._hear)
        self._socket, self._requests = None, 0
        self._role, self._live = role, LiveSettings(**live).model_dump(mode="json")
        self.tab.route_web_socket("**/ws", self._open)
        self.tab.goto(f"{origin}/{LETTERS[role]}/token")

    def _hear(self, message):
        if "Content Security Policy" in message.text:
            self.errors.append(message.text)

    def _open(self, socket):
        self._socket = socket
        socket.on_message(lambda text: self._take(json.loads(text)))

    def _take(self, message):
        self.received.append(message)
        if message["type"] == "hello":
            live = self._live | {"view": self._view()}
            self.send("welcome", role=self._role, course=course_picture(COURSE), courses={},
                      live=live, period_s=0.1)  # fmt: skip
            self.send("ping", id=1, round_trip_ms=12.0)

    def _view(self):
        return self._live["demonstrator_view" if self._role == "demonstrator" else "view"]

    def send(self, kind, /, **message):
        """Send what a server would."""
        self._socket.send(json.dumps({"type": kind, **message}))

    def page(self, kind, **content):
        """Show a page."""
        self._requests += 1
        self.send("page", request=self._requests, kind=kind, **content)

    def answers(self):
        """Return what was entered, page by page."""
        return [m["entered"] for m in self.received if m["type"] == "answer"]

    def said(self, kind):
        """Return the messages of a kind that the page has sent."""
        return [m for m in self.received if m["type"] == kind]

    def wait(self, name):
        """Return an element, once it is there."""
        found = self.tab.get_by_test_id(name)
        found.wait_for()
        return found

    def until(self, condition, seconds=120):
        """Let the page go on until something is true."""
        for _ in range(10 * seconds):
            if condition():
                return
            self.tab.wait_for_timeout(100)
        raise AssertionError("it did not happen in time")


@pytest.fixture(scope="module")
def origin():
    """Return where the pages are served."""
    served = Served()
    yield served.origin
    served.close()


@pytest.fixture
def opened(browser, origin):
    """Return a function that opens a role's page; no script of it may fail."""
    contexts, stages = [], []

    def start(role, **live):
        contexts.append(browser.new_context())
        stages.append(Staged(contexts[-1], origin, role, **live))
        stages[-1].until(lambda: stages[-1].said("hello"))
        return stages[-1]

    yield start
    for context in contexts:
        context.close()
    assert [error for stage in stages for error in stage.errors] == []
