"""The machine itself: cores, disk, rights, clock, compilers, ports, gamepads."""

import os
import platform
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

from harness.doctor.finding import Finding
from harness.running.processes import LONGEST_FOLDER, temporary_folder

LEAST_FREE = 200_000_000
"""Free disk below which a study may not fit, bytes: twelve people's four laps take about 10 MB."""

LIVE_PORT = 8080
"""Port that ``lad-study live`` takes unless it is told another."""

LATE_S = 0.05
"""A live step that starts later than this moves the lap's zero of time, s."""

_COMPILERS = ("c++", "g++", "clang++", "cl")


def machine_findings(cores: int, folder: Path) -> Iterator[Finding]:
    """Yield what is known of the machine; nothing is left behind.

    Parameters
    ----------
    cores
        Cores that this process may use.
    folder
        Where a study would be written.
    """
    yield Finding("system", platform.platform())
    yield Finding("cores", f"{cores} that this process may use, of {os.cpu_count()}")
    yield _compiler()
    yield _disk(folder)
    yield _writable("working folder", folder)
    yield _writable("temporary folder", Path(tempfile.gettempdir()))
    yield _socket_path()
    yield _clock()
    yield _port()
    yield _gamepad()


def _compiler() -> Finding:
    """Return which C++ compiler there is: only PyBullet without a wheel needs one."""
    path = next(filter(None, map(shutil.which, _COMPILERS)), None)
    if path is None:
        return Finding("C++ compiler", "none; needed only where PyBullet has no wheel")
    try:
        said = subprocess.run(  # noqa: S603  # a compiler that the system's own path names
            [path, "--version"], capture_output=True, text=True, timeout=10, check=False
        ).stdout
    except (OSError, subprocess.SubprocessError):
        said = ""
    return Finding("C++ compiler", (said.splitlines() or [path])[0])


def _disk(folder: Path) -> Finding:
    free = shutil.disk_usage(folder).free
    found = f"{free / 1e9:.1f} GB free in {folder}"
    if free >= LEAST_FREE:
        return Finding("disk", found)
    mend = f"free {LEAST_FREE / 1e6:.0f} MB, or go to a folder on another disk"
    return Finding("disk", found, ("run", "live"), mend)


def _writable(what: str, folder: Path) -> Finding:
    """Try to write a file; it is removed at once."""
    try:
        with tempfile.NamedTemporaryFile(dir=folder):
            return Finding(what, f"{folder}: can be written")
    except OSError as error:
        found = f"{folder}: cannot be written: {error.strerror}"
        mend = f"go to another folder, or: chmod u+w {folder}"
        return Finding(what, found, ("run", "live"), mend)


def _socket_path() -> Finding:
    what = "temporary path"
    found = tempfile.gettempdir()
    length = len(os.fsencode(found))
    chosen = temporary_folder()
    if chosen is None:
        mend = "export TMPDIR=/tmp"
        said = f"{length} bytes, and no other; sockets need {LONGEST_FOLDER} or fewer"
        return Finding(what, said, ("run",), mend)
    instead = "" if chosen == found else f"; sockets are made in {chosen} instead"
    return Finding(what, f"{length} bytes of {LONGEST_FOLDER}{instead}")


def _clock() -> Finding:
    """Return what time it is, and how late a short sleep ends: steps of live laps are timed."""
    late = 0.0
    for _ in range(5):
        before = time.perf_counter()
        time.sleep(0.01)
        late = max(late, time.perf_counter() - before - 0.01)
    now = datetime.now(UTC)
    found = f"{now:%Y-%m-%d %H:%M:%S} UTC; sleeps of 10 ms end {1000 * late:.1f} ms late at most"
    built = datetime.fromtimestamp(Path(__file__).stat().st_mtime, UTC)
    if now < built:
        found = f"{found}; before this package was installed"
        return Finding("clock", found, ("live",), "set the clock")
    if late > LATE_S:
        mend = "end other programs: live steps would start late"
        return Finding("clock", found, ("live",), mend)
    return Finding("clock", found)


def _port() -> Finding:
    with socket.socket() as one:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            one.bind(("127.0.0.1", LIVE_PORT))
        except OSError as error:
            found = f"{LIVE_PORT} cannot be taken: {error.strerror}"
            return Finding("port", found, (), "lad-study live ... --port 0")
    return Finding("port", f"{LIVE_PORT} is free")


def _gamepad() -> Finding:
    """Return the gamepads that Linux knows; elsewhere only a browser can tell."""
    if not Path("/dev/input").is_dir():
        return Finding("gamepad", "not known here; the live page tells when a button is pressed")
    pads = sorted(path.name for path in Path("/dev/input").glob("js*"))
    return Finding("gamepad", ", ".join(pads) or "none; keyboard and touch work")
