"""The command line as a person runs it: other processes, that can be watched and killed."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

import psutil
import pytest

QUICK = Path(__file__).with_name("quick.yaml")
PACKAGES = Path(__file__).parents[2]


class Ended(NamedTuple):
    """A command that has ended."""

    code: int
    out: str
    err: str


class Started:
    """A command that is running, in a process group of its own."""

    def __init__(self, *arguments, cwd, largest_file=None, **environment):
        path = os.pathsep.join(filter(None, [str(PACKAGES), environment.pop("PYTHONPATH", "")]))
        self.process = subprocess.Popen(  # noqa: S603  # our own command
            [sys.executable, "-c", _code(largest_file), *map(str, arguments)],
            cwd=cwd,
            env={**os.environ, "PYTHONPATH": path, **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def ended(self):
        """Wait for its end."""
        out, err = self.process.communicate(timeout=600)
        return Ended(self.process.returncode, out, err)

    def descendants(self):
        """Return every process it has started, itself or by others."""
        try:
            return psutil.Process(self.process.pid).children(recursive=True)
        except psutil.NoSuchProcess:
            return []

    def workers(self):
        """Return the processes that run sessions: those the fork server has forked."""
        return [p for p in self.descendants() if _parent(p) != self.process.pid]

    def kill(self):
        """Kill -9, and forget what it said."""
        self.process.send_signal(signal.SIGKILL)
        self.process.communicate()

    def interrupt(self):
        """Ctrl-C: a terminal sends it to the whole group."""
        os.killpg(self.process.pid, signal.SIGINT)


def _code(largest_file):
    # A shell that runs the tests in the background may have made all it starts ignore Ctrl-C.
    hear = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    code = f"{hear}; from harness.cli import main; main()"
    if largest_file is None:
        return code
    limit = f"resource.setrlimit(resource.RLIMIT_FSIZE, ({largest_file}, {largest_file}))"
    return f"import resource; {limit}; {code}"


def _parent(process):
    try:
        return process.ppid()
    except psutil.NoSuchProcess:
        return None


@pytest.fixture(scope="session")
def packages():
    """Return the folder that holds the packages under test."""
    return PACKAGES


@pytest.fixture
def start(tmp_path):
    """Return the function that starts ``lad-study`` with these arguments."""
    started = []

    def begin(*arguments, **environment):
        started.append(Started(*arguments, cwd=tmp_path, **environment))
        return started[-1]

    yield begin
    for run in started:
        if run.process.poll() is None:
            run.kill()


@pytest.fixture
def run_quick(start):
    """Return the function that runs the quick study into a folder, and waits for its end."""

    def run(out, *options, **environment):
        return start("run", QUICK, "--no-report", "--out", out, *options, **environment).ended()

    return run


@pytest.fixture
def start_quick(start):
    """Return the function that starts the quick study into a folder."""
    return lambda out, *options: start("run", QUICK, "--no-report", "--out", out, *options)


@pytest.fixture(scope="session")
def record():
    """Return the function that reads a study's record: all but logs, report, head and lock."""

    def read(folder):
        files = (p for p in folder.rglob("*") if p.is_file())
        named = {p.relative_to(folder).as_posix(): p for p in files}
        return {
            name: path.read_bytes()
            for name, path in named.items()
            if not name.startswith(("logs/", "report/")) and name not in {"study.yaml", ".lock"}
        }

    return read


@pytest.fixture(scope="session")
def undisturbed_study(tmp_path_factory):
    """Return the directory of a quick study that nothing has happened to; not to be touched."""
    folder = tmp_path_factory.mktemp("undisturbed")
    run = Started("run", QUICK, "--no-report", "--out", "study", "--jobs", 2, cwd=folder)
    ended = run.ended()
    assert ended.code == 0, ended.err
    return folder / "study"


@pytest.fixture(scope="session")
def undisturbed(undisturbed_study, record):
    """Return its record."""
    return record(undisturbed_study)


@pytest.fixture(scope="session")
def wait_until():
    """Return the function that waits, for at most two minutes, until something holds."""

    def wait(condition):
        deadline = time.monotonic() + 120
        while not condition():
            assert time.monotonic() < deadline, "it did not happen within two minutes"
            time.sleep(0.01)

    return wait


@pytest.fixture(scope="session")
def finished():
    """Return the function that counts a study directory's finished sessions."""
    return lambda folder: len(list((folder / "sessions").glob("P*")))
