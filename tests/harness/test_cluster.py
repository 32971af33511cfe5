"""A cluster that is not there is an input fault; what one does with work is tested end to end."""

import socket
import sys

import pytest

from harness import cluster
from harness.processes import Died
from protocols.errors import InputError


def test_without_dask_the_extra_is_named(monkeypatch):
    """What to install is said, and nothing is tried."""
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'lad-study\[cluster\]'"):
        cluster.cluster("tcp://127.0.0.1:8786").__enter__()


@pytest.mark.parametrize("address", ["nonsense://here", "tcp://127.0.0.1:{free}"])
def test_where_no_scheduler_answers_the_address_is_named(monkeypatch, address):
    """The address, and what one looks like, are said within the patience there is."""
    pytest.importorskip("distributed")
    monkeypatch.setattr(cluster, "PATIENCE_S", 0.5)
    with socket.socket() as taken:  # bound, but nobody listens
        taken.bind(("127.0.0.1", 0))
        address = address.format(free=taken.getsockname()[1])
        with pytest.raises(InputError) as error:
            cluster.cluster(address).__enter__()
    assert address in str(error.value)
    assert "tcp://host:8786" in str(error.value)


class Future:
    """Something a cluster was asked to do, and what became of it."""

    def __init__(self, answer):
        self.answer = answer

    def cancelled(self):
        return self.answer is None

    def exception(self):
        return self.answer if isinstance(self.answer, Exception) else None

    def result(self):
        return self.answer


class Client:
    """A cluster of two threads that does everything at once."""

    def __init__(self):
        self.under_way, self.most = 0, 0
        self.status, self.fault = "running", None

    def nthreads(self):
        if self.fault:
            raise self.fault
        return {"tcp://a": 1, "tcp://b": 1}

    def submit(self, task, number, *, pure):
        assert not pure
        self.under_way += 1
        self.most = max(self.most, self.under_way)
        return Future(task(number))


@pytest.fixture
def run(monkeypatch):
    """Return the function that runs a task for numbers on such a cluster."""
    distributed = pytest.importorskip("distributed")
    client = Client()

    def as_completed():
        waiting = []

        class Completed:
            add = staticmethod(waiting.append)

            def __next__(self):
                client.under_way -= 1
                return waiting.pop()

        return Completed()

    monkeypatch.setattr(distributed, "as_completed", as_completed)
    return client, lambda task, numbers: list(cluster.Cluster(client).run(task, numbers))


def test_no_more_than_a_few_tasks_are_on_the_cluster(run):
    """All numbers are answered, and answers never pile up."""
    client, answers = run
    assert sorted(answers(lambda n: n * n, range(50))) == [(n, n * n) for n in range(50)]
    assert client.most == 2 * cluster.AHEAD


def test_a_number_that_the_cluster_gives_up_has_died(run):
    """The cluster's reason is kept, and nothing else is lost."""
    _, answers = run
    told = dict(answers(lambda n: MemoryError("worker lost") if n == 3 else n, range(5)))
    assert told.pop(3) == Died("MemoryError: worker lost")
    assert told == {0: 0, 1: 1, 2: 2, 4: 4}


def test_a_lost_scheduler_is_an_error_of_the_run(run):
    """Not of the participants under way, who are going to be run again."""
    _, answers = run
    with pytest.raises(ConnectionError, match="scheduler was lost"):
        answers(lambda n: None if n == 3 else n, range(5))


@pytest.mark.parametrize(
    ("status", "fault"),
    [
        ("running", ConnectionResetError(104, "Connection reset by peer")),
        ("connecting", TimeoutError("no answer")),
        ("closed", RuntimeError("Client is closed")),
    ],
)
def test_a_scheduler_lost_in_any_call_is_told_in_the_same_words(run, status, fault):
    """Whether the loss shows in a call's own connection or in a result is a matter of timing."""
    client, answers = run
    client.status, client.fault = status, fault
    with pytest.raises(ConnectionError, match=r"^the Dask scheduler was lost; the same command"):
        answers(lambda n: n, range(5))


def test_a_fault_of_ours_is_not_taken_for_a_lost_scheduler(run):
    """While the client is connected, what is raised stays what it is."""
    client, answers = run
    client.fault = RuntimeError("something else")
    with pytest.raises(RuntimeError, match="something else"):
        answers(lambda n: n, range(5))
