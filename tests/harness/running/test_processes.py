"""Worker processes: every number is answered once, whichever worker dies."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from functools import partial
from pathlib import Path

import pytest

from harness.running.processes import Processes, signals_afterwards
from harness.running.workers import MAX_DEATHS, Died

TASKS = '''
import os, signal, time
from pathlib import Path

def square(number):
    return number * number

def environment(number):
    return {name: os.environ.get(name) for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")}

def interrupted(number):
    os.kill(os.getpid(), signal.SIGINT)
    return number

def ended(number):
    os._exit(7) if number == 2 else None
    return number

def killed(folder, fatal, times, number):
    """Die of some numbers, the first few times they are tried."""
    with (Path(folder) / f"{number}").open("a") as log:
        log.write("x")
    if number in fatal and (Path(folder) / f"{number}").stat().st_size <= times:
        os.kill(os.getpid(), signal.SIGKILL)
    return number

def unfit(number):
    from harness.running.workers import Died
    return Died(f"unfit: {os.getpid()}") if number == 1 else number

class Fatal:
    def __reduce__(self):
        os.kill(os.getpid(), signal.SIGKILL)

def killed_while_answering(number):
    return Fatal() if number == 1 else number


def napper(folder, number):
    (Path(folder) / f"{os.getpid()}").touch()
    time.sleep(0.5)
'''


@pytest.fixture
def tasks(tmp_path, monkeypatch):
    """Return a module of tasks that worker processes can import."""
    (tmp_path / "some_tasks.py").write_text(TASKS)
    monkeypatch.syspath_prepend(tmp_path)
    import some_tasks

    yield some_tasks
    del sys.modules["some_tasks"]


def run(task, numbers, jobs=2):
    """Return every answer in the order of arrival."""
    with Processes(jobs) as workers:
        return list(workers.run(task, numbers))


def wait_until(condition):
    """Wait, for at most a minute, until something holds."""
    deadline = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < deadline, "it did not happen within a minute"
        time.sleep(0.02)


def alive(pid):
    """Tell whether a process runs; a zombie does not."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


@pytest.mark.parametrize("jobs", [1, 2, 5])
def test_every_number_is_answered_once(tasks, jobs):
    """However many processes there are, fewer or more than numbers."""
    assert sorted(run(tasks.square, range(4), jobs)) == [(n, n * n) for n in range(4)]


def test_the_same_processes_serve_again(tasks):
    """A second run uses the processes of the first."""
    with Processes(2) as workers:
        first = list(workers.run(tasks.square, range(4)))
        before = {p.pid for p in multiprocessing.active_children()}
        second = list(workers.run(tasks.square, range(4)))
        assert {p.pid for p in multiprocessing.active_children()} == before
    assert sorted(first) == sorted(second)


def test_a_number_whose_process_was_killed_is_tried_again(tasks, tmp_path):
    """A kill costs one attempt and is reported; no other number is run twice."""
    answers = run(partial(tasks.killed, tmp_path, {2, 3}, 1), range(6))
    died = [(n, a) for n, a in answers if isinstance(a, Died)]
    assert sorted(n for n, _ in died) == [2, 3]
    assert all(a.retried and "SIGKILL" in a.reason for _, a in died)
    assert sorted(n for n, a in answers if a == n) == list(range(6))
    tries = {n: (tmp_path / f"{n}").stat().st_size for n in range(6)}
    assert tries == {0: 1, 1: 1, 2: 2, 3: 2, 4: 1, 5: 1}


def test_a_number_that_kills_every_process_is_given_up(tasks, tmp_path):
    """It is given up after its last chance; all others are answered."""
    answers = run(partial(tasks.killed, tmp_path, {1}, 99), range(5))
    assert [a.retried for n, a in answers if n == 1] == [True] * (MAX_DEATHS - 1) + [False]
    assert sorted(n for n, a in answers if a == n) == [0, 2, 3, 4]


def test_a_death_while_the_answer_is_sent_is_a_death(tasks):
    """Half an answer is none."""
    answers = run(tasks.killed_while_answering, [1, 2])
    assert Counter(n for n, a in answers if isinstance(a, Died)) == {1: MAX_DEATHS}
    assert (2, 2) in answers


def test_a_process_that_ends_by_itself_is_told_from_a_killed_one(tasks):
    """The exit code is part of the reason."""
    reasons = {a.reason for n, a in run(tasks.ended, [1, 2], 1) if isinstance(a, Died)}
    assert reasons == {"its process ended by itself with exit code 7"}


def test_a_process_that_says_it_is_unfit_is_replaced(tasks):
    """Each try is made in a process of its own, and the others' numbers are answered."""
    answers = run(tasks.unfit, [1, 2], 1)
    unfit = [a for n, a in answers if n == 1]
    assert [a.retried for a in unfit] == [True] * (MAX_DEATHS - 1) + [False]
    assert len({a.reason for a in unfit}) == MAX_DEATHS
    assert (2, 2) in answers


def test_linear_algebra_uses_one_thread_and_only_in_workers(tasks, monkeypatch):
    """The workers' environment says so, and this process's is as it was."""
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    ((_, there),) = run(tasks.environment, [1])
    assert there["OPENBLAS_NUM_THREADS"] == "1"
    assert os.environ["OMP_NUM_THREADS"] == "3"
    assert "OPENBLAS_NUM_THREADS" not in os.environ


def test_workers_leave_ctrl_c_to_the_runner(tasks):
    """An interrupt that reaches the whole process group does not end them."""
    assert sorted(run(tasks.interrupted, [1, 2])) == [(1, 1), (2, 2)]


def test_when_the_context_ends_busy_workers_are_gone(tasks, tmp_path):
    """An error of the caller's does not leave processes behind, nor wait for them."""
    folder = tmp_path / "pids"
    folder.mkdir()

    def fail():
        with Processes(2) as workers:
            answers = workers.run(partial(tasks.napper, folder), range(100))
            next(answers)
            raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        fail()
    pids = [int(p.name) for p in folder.iterdir()]
    assert len(pids) == 2
    assert not any(map(alive, pids))


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks at /proc")
def test_workers_end_when_the_runner_is_killed(tasks, tmp_path):
    """After kill -9 of the runner, each worker ends with the task it is in."""
    folder = tmp_path / "pids"
    folder.mkdir()
    script = tmp_path / "runner.py"
    script.write_text(
        "import sys\n"
        "from functools import partial\n"
        "from harness.running.processes import Processes\n"
        "import some_tasks\n"
        "if __name__ == '__main__':\n"
        "    with Processes(2) as workers:\n"
        f"        list(workers.run(partial(some_tasks.napper, {str(folder)!r}), range(1000)))\n"
    )
    path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    runner = subprocess.Popen(  # noqa: S603  # our own script
        [sys.executable, str(script)], env={**os.environ, "PYTHONPATH": path}
    )
    wait_until(lambda: len(list(folder.iterdir())) == 2)
    runner.send_signal(signal.SIGKILL)
    runner.wait()
    pids = [int(p.name) for p in folder.iterdir()]
    wait_until(lambda: not any(map(alive, pids)))


def test_a_long_temporary_folder_does_not_matter(tasks, tmp_path):
    """The socket of the fork server has a path of at most 107 bytes, wherever TMPDIR is."""
    folder = tmp_path / ("a-long-name-" * 12)
    folder.mkdir()
    script = tmp_path / "runner.py"
    script.write_text(
        "from harness.running.processes import Processes\n"
        "import some_tasks\n"
        "if __name__ == '__main__':\n"
        "    with Processes(1) as workers:\n"
        "        print(list(workers.run(some_tasks.square, [3])))\n"
    )
    path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    done = subprocess.run(  # noqa: S603  # our own script
        [sys.executable, str(script)],
        env={**os.environ, "PYTHONPATH": path, "TMPDIR": str(folder)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr) == ("[(3, 9)]\n", "")
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_waits_until_a_process_has_started(number):
    """It is not lost, and it does not come in the middle."""
    came = []
    kept = signal.signal(number, lambda *_: came.append("acted on"))
    try:
        with signals_afterwards():
            signal.raise_signal(number)
            came.append("started")
    finally:
        signal.signal(number, kept)
    assert came == ["started", "acted on"]
