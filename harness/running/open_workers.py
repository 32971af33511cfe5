"""Where sessions run: in processes of this machine, or on a cluster."""

from contextlib import AbstractContextManager

from harness.running.processes import Processes, warm_up
from harness.running.workers import Workers


def open_workers(jobs: int, scheduler: str | None = None) -> AbstractContextManager[Workers]:
    """Return the workers, for as long as a context lasts.

    Parameters
    ----------
    jobs
        Number of processes on this machine.
    scheduler
        Address of a Dask scheduler; its workers then run the sessions.

    Raises
    ------
    InputError
        On entering: when there is no scheduler at the address, or Dask is not installed.
    """
    if scheduler is None:
        warm_up_workers()
        return Processes(jobs)
    from harness.running.cluster import cluster  # noqa: PLC0415  # it names Dask, an extra

    return cluster(scheduler)


def warm_up_workers() -> None:
    """Begin to start this machine's workers, in the background."""
    warm_up(["harness.session.session", "harness.world.bullet_world", "harness.cli"])
