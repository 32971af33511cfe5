"""Sessions in worker processes: the same bytes anywhere, and no failure goes unsaid."""

import pytest

from harness.running.open_workers import open_workers
from harness.running.sessions import attempt, run_sessions, try_parts
from harness.running.workers import MAX_DEATHS, Died, Failed, Finished
from harness.session.study_run import portable
from protocols.files.errors import InputError

pytestmark = pytest.mark.usefixtures("ready")


QUITTER = """
import sys

class Quitter:
    def start_lap(self, lap, rng): pass
    def act(self, sight): {end}

def quitter(setup): return Quitter()

def never(setup): {end}
"""


def sessions(run, numbers, jobs):
    """Return what became of each session, by number; the last word counts."""
    with open_workers(jobs) as workers:
        return dict(run_sessions(workers, run, numbers))


def test_a_session_is_a_function_of_run_and_number(make_run):
    """Here or in a worker, alone or after others, first or again: the same bytes."""
    run = portable(make_run(participants=4))
    here = {n: attempt(run, n).files for n in (3, 1, 3, 2, 4)}
    for jobs in (1, 2):
        there = sessions(run, [4, 3, 2, 1], jobs)
        assert {n: there[n].files for n in there} == here
    assert len({files["steps-0.parquet"] for files in here.values()}) == 4


def test_a_session_that_raises_fails_alone(make_run, unlucky, tmp_path):
    """Its traceback comes back; the other participants' sessions finish."""
    (tmp_path / "mood").touch()
    driver = f"{{use: 'some_drivers:moody', options: {{file: '{tmp_path / 'mood'}'}}}}"
    run = make_run(participants=6, driver=driver)
    ended = sessions(run, range(1, 7), 2)
    failed = [n for n in ended if isinstance(ended[n], Failed)]
    assert 0 < len(failed) < 6
    assert sorted(failed) == unlucky(run)
    assert all(ended[n].trace.endswith("RuntimeError: I am in no mood\n") for n in failed)
    assert all(isinstance(ended[n], Finished) for n in ended if n not in failed)


@pytest.mark.parametrize("end", ["sys.exit(3)", "raise KeyboardInterrupt"])
def test_who_would_end_the_program_ends_a_session(make_run, tmp_path, end):
    """The worker continues, and the traceback names the cause; also in the check of all parts."""
    (tmp_path / "quitter.py").write_text(QUITTER.format(end=end))
    ended = sessions(make_run(driver="{use: 'quitter:quitter'}"), [1, 2], 1)
    assert {type(session) for session in ended.values()} == {Failed}
    assert all(f"def act(self, sight): {end}" in session.trace for session in ended.values())
    with open_workers(1) as workers, pytest.raises(InputError, match=r"quitter\.py"):
        try_parts(workers, make_run(driver="{use: 'quitter:never'}"))


def test_where_nobody_can_be_made_the_process_is_unfit(make_run, tmp_path):
    """That is not the participant's failure: another process may run the session."""
    (tmp_path / "needy.py").write_text("import no_module\n")
    answer = attempt(make_run(driver="{use: 'needy:driver'}"), 3)
    assert isinstance(answer, Died)
    assert "No module named 'no_module'" in answer.reason
    assert "\n" not in answer.reason


def test_a_session_that_kills_its_process_fails_alone(make_run, unlucky):
    """It is given up after some processes; the other participants' sessions finish."""
    run = make_run(participants=4, driver="{use: 'some_drivers:deadly'}")
    with open_workers(2) as workers:
        told = list(run_sessions(workers, run, range(1, 5)))
    assert 0 < len(unlucky(run)) < 4
    died = [n for n, session in told if isinstance(session, Died)]
    assert sorted(died) == sorted(unlucky(run) * MAX_DEATHS)
    finished = [n for n, session in told if isinstance(session, Finished)]
    assert sorted(finished + unlucky(run)) == [1, 2, 3, 4]


def test_warnings_come_back_with_the_session(make_run):
    """What Python warns of in a worker is kept, not printed between the lines."""
    run = make_run(driver="{use: 'some_drivers:warner'}")
    (session,) = sessions(run, [2], 1).values()
    assert len(session.warned) == 1
    assert "some_drivers.py" in session.warned[0]
    assert session.warned[0].endswith("UserWarning: it is getting late")
    assert session.wall_s > 0


@pytest.mark.parametrize(
    ("driver", "parts"),
    [
        ("{use: 'some_drivers:none_such'}", ["some_drivers", "none_such"]),
        ("{use: 'some_drivers:impossible'}", ["ValueError: no such thing", "some_drivers.py"]),
        ("{use: human, options: {speed: 9}}", ["speed"]),
    ],
)
def test_a_part_that_cannot_be_made_is_an_input_fault(make_run, driver, parts):
    """The parts are checked where the sessions are run, and faults come back as one line."""
    with open_workers(1) as workers, pytest.raises(InputError) as error:
        try_parts(workers, make_run(driver=driver))
    for part in parts:
        assert part in str(error.value)
    assert "\n" not in str(error.value)


def test_a_run_whose_parts_can_be_made_passes_the_check(make_run):
    """The workers that checked the parts also run the sessions."""
    run = make_run()
    with open_workers(1) as workers:
        try_parts(workers, run)
        assert [n for n, _ in run_sessions(workers, run, [1])] == [1]
