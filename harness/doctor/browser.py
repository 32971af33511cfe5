"""A browser on this machine, and whether it can draw the first-person view."""

import importlib
import os
import shutil

from harness.doctor.finding import Finding

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome", "firefox")

_ASK = """() => {
  const gl = document.createElement("canvas").getContext("webgl");
  if (!gl) return "";
  const named = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}"""


def browser_findings() -> tuple[Finding, Finding]:
    """Return which browser there is, and its WebGL where playwright can ask for it.

    Neither stops anything: participants may sit at other machines, and drive by the plan without
    WebGL.
    """
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        nothing = Finding("browser", "none found; live pages need one, here or elsewhere")
        return nothing, Finding("WebGL", "not known without a browser")
    return Finding("browser", path), Finding("WebGL", _webgl(path))


def _webgl(path: str) -> str:
    """Return in words what draws, asked of the browser itself."""
    try:
        playwright = importlib.import_module("playwright.sync_api")
    except ModuleNotFoundError:
        return "not known: pip install playwright, and look again"
    if "firefox" in path:
        return "not known: playwright asks Chromium only"
    # As root there is no sandbox to be had.
    root = hasattr(os, "geteuid") and os.geteuid() == 0
    try:
        with playwright.sync_playwright() as play:
            chromium = play.chromium.launch(
                executable_path=path, args=["--no-sandbox"] if root else []
            )
            drawn = str(chromium.new_page().evaluate(_ASK))
            chromium.close()
    except playwright.Error as error:
        return f"not known: the browser does not start: {str(error).splitlines()[0]}"
    return f"yes: {drawn}" if drawn else "no: participants would drive by the plan"
