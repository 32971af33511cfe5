"""A cluster that is not there is an input fault; what one does with work is tested end to end."""

import socket
import sys
from functools import partial

import pytest

from harness.running import cluster
from harness.running.workers import MAX_DEATHS, Died, Failed
from protocols.files.errors import InputError


def test_without_dask_the_extra_is_named(monkeypatch):
    """What to install is said, and nothing is tried."""
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'lad-study\[cluster\]'"):
        cluster.cluster("tcp://127.0.0.1:8786").__enter__()


@pytest.mark.parametrize(
    "address", ["nonsense://here", "tls://127.0.0.1:{free}", "tcp://127.0.0.1:{free}"]
)
def test_where_no_scheduler_answers_the_address_is_named(monkeypatch, address):
    """The address, and what one looks like, are said within the patience there is."""
    pytest.importorskip("distributed")
    monkeypatch.setattr(cluster, "PATIENCE_S", 0.5)
    with socket.socket() as taken:  # bound, but not listening
        taken.bind(("127.0.0.1", 0))
        address = address.format(free=taken.getsockname()[1])
        with pytest.raises(InputError) as error:
            cluster.cluster(address).__enter__()
    assert address in str(error.value)
    assert "tcp://host:8786" in str(error.value)


def double(number):
    """Return what the cluster is to work out."""
    return 2 * number


def failing(answer, number):
    """Return this in place of the answer for number 3."""
    return answer if number == 3 else number


def choosy(worker, number):
    """Run on no other worker than this one."""
    import distributed

    there = distributed.get_worker().address
    return number if there == worker else Died("no such driver")


class Future:
    """Something a cluster was asked to do, and what became of it."""

    def __init__(self, answer, ended):
        self.answer, self.ended = answer, ended

    def add_done_callback(self, tell):
        tell(self)

    def cancelled(self):
        self.ended()
        return self.answer is None

    def exception(self):
        return self.answer if isinstance(self.answer, Exception) else None

    def result(self):
        return self.answer


class Client:
    """A cluster of single threads that does everything at once, on the worker that came last."""

    def __init__(self):
        self.under_way, self.most = 0, 0
        self.status, self.fault = "running", None
        self.workers = ["tcp://a", "tcp://b"]
        self.happening = {}

    def nthreads(self):
        if self.fault:
            raise self.fault
        return dict.fromkeys(self.workers, 1)

    def submit(self, task, number, *, pure):
        assert not pure
        self.under_way += 1
        self.most = max(self.most, self.under_way)
        try:
            answer = self.happening[number] if number in self.happening else task(number)
        except RuntimeError as error:
            answer = error
        return Future(answer, self.ended)

    def ended(self):
        self.under_way -= 1

    @property
    def address(self):
        return self.workers[-1]

    def retire_workers(self, addresses):
        self.workers = [address for address in self.workers if address not in addresses]


@pytest.fixture
def run(monkeypatch):
    """Return such a cluster, and the function that runs a task for numbers on it."""
    distributed = pytest.importorskip("distributed")
    client = Client()
    monkeypatch.setattr(distributed, "get_worker", lambda: client)
    monkeypatch.setattr(socket, "gethostname", lambda: "node7")
    workers = cluster.Cluster(client, "tcp://head:8786")
    return client, lambda task, numbers: list(workers.run(task, numbers))


def test_no_more_than_a_few_tasks_are_on_the_cluster(run):
    """All numbers are answered, and answers never pile up."""
    client, answers = run
    assert sorted(answers(double, range(50))) == [(n, 2 * n) for n in range(50)]
    assert client.most == 2 * cluster.AHEAD


def test_a_number_that_the_cluster_gives_up_has_died(run):
    """Dask has tried it on several workers; its reason is kept, and nothing else is lost."""
    client, answers = run
    from distributed import KilledWorker

    client.happening[3] = KilledWorker("task", client, 3)
    told = dict(answers(double, range(5)))
    assert told.pop(3).reason.startswith("KilledWorker: ")
    assert told == {0: 0, 1: 2, 2: 4, 4: 8}


def test_a_worker_that_can_run_nothing_leaves(run):
    """Its numbers are run by another one, and the machine's name is told."""
    client, answers = run
    told = answers(partial(choosy, "tcp://a"), range(20))
    assert client.workers == ["tcp://a"]
    assert sorted(n for n, answer in told if answer == n) == list(range(20))
    died = [answer for _, answer in told if isinstance(answer, Died)]
    assert set(died) == {Died("on node7: no such driver", retried=True, unfit=True)}
    assert len(died) <= 2 * cluster.AHEAD


def test_a_number_that_no_worker_can_run_is_given_up(run):
    """After a few workers, of which more keep coming."""
    client, answers = run
    client.workers = [f"tcp://{n}" for n in range(9)]
    told = answers(partial(choosy, "tcp://none"), [1])
    assert [answer.retried for _, answer in told] == [True] * (MAX_DEATHS - 1) + [False]
    assert "on node7" in told[-1][1].reason


def test_what_the_cluster_cannot_do_is_tried_again(run):
    """It may have been one worker's fault; which one's, Dask does not say."""
    client, answers = run
    client.happening[1] = ModuleNotFoundError("No module named 'harness'")
    told = answers(double, [1])
    assert len(told) == MAX_DEATHS
    assert told[-1][1] == Died("ModuleNotFoundError: No module named 'harness'")


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        (Failed("Traceback"), Failed("On node7:\nTraceback")),
        (InputError("no such driver"), InputError("no such driver (on node7)")),
    ],
)
def test_failures_name_the_machine(run, answer, told):
    """A failure may be a machine's."""
    _, answers = run
    assert repr(dict(answers(partial(failing, answer), range(5)))[3]) == repr(told)


def test_when_no_worker_is_left_that_is_said_once(run, monkeypatch, caplog):
    """The run waits, and continues as soon as there is one."""
    client, answers = run
    monkeypatch.setattr(cluster, "LOOK_S", 0.01)
    looks, held = [], []
    monkeypatch.setattr(Future, "add_done_callback", lambda f, tell: held.append((f, tell)))

    def nthreads():
        looks.append(None)
        if len(looks) == 5:
            for future, tell in held:
                tell(future)
        return {}

    monkeypatch.setattr(client, "nthreads", nthreads)
    assert answers(double, [1]) == [(1, 2)]
    (said,) = caplog.messages
    assert said.startswith("no worker is left at tcp://head:8786: waiting for one (Ctrl-C stops")


def test_a_lost_scheduler_is_an_error_of_the_run(run):
    """Not of the participants under way, who are going to be run again."""
    client, answers = run
    client.happening[3] = None
    with pytest.raises(ConnectionError, match="scheduler was lost"):
        answers(double, range(5))


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
        answers(double, range(5))


def test_a_fault_of_ours_is_not_taken_for_a_lost_scheduler(run):
    """While the client is connected, what is raised stays what it is."""
    client, answers = run
    client.fault = RuntimeError("something else")
    with pytest.raises(RuntimeError, match="something else"):
        answers(double, range(5))
