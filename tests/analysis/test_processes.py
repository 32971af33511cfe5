"""Other processes give what this one gives."""

import pytest

from analysis.processes import HERE, processes


@pytest.mark.parametrize("jobs", [1, 2])
def test_work_comes_back_in_order(jobs):
    """However many processes there are, and whichever is ready first."""
    with processes(jobs) as others:
        assert list(others.in_order(abs, range(-20, 0))) == list(range(20, 0, -1))
        waiting = [others.later(divmod, number, 3) for number in (7, 8)]
        assert [wait() for wait in waiting] == [(2, 1), (2, 2)]


@pytest.mark.parametrize("jobs", [1, 2])
def test_what_work_raises_is_raised_here(jobs):
    """Where its result is asked for, not before."""
    with processes(jobs) as others:
        waiting = others.later(divmod, 1, 0)
        with pytest.raises(ZeroDivisionError):
            waiting()


def test_without_processes_nothing_is_started():
    """One process is this one."""
    with processes(1) as others:
        assert others is HERE
