"""A real browser, for what only a browser can tell: skipped in one line where there is none."""

import json
import math
import shutil
import subprocess
import sys
import time

import pytest

from protocols.course.centreline import Centreline

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
