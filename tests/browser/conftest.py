"""A real browser, for what only a browser can tell: skipped in one line where there is none."""

import shutil

import pytest

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
