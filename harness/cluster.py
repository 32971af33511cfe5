"""A Dask cluster, when one machine is not enough: ``pip install 'lad-study[cluster]'``."""

from collections.abc import Iterator
from contextlib import contextmanager

from protocols.errors import InputError

PATIENCE_S = 15
"""How long a scheduler may take to answer, s."""


@contextmanager
def dask_client(scheduler: str) -> Iterator[None]:
    """Connect to a scheduler for as long as the context lasts.

    Raises
    ------
    InputError
        When Dask is not installed, or no scheduler answers at the address.
    """
    try:
        from distributed import Client  # noqa: PLC0415  # an extra
    except ImportError:
        raise InputError(
            "--scheduler: needs Dask; install it with pip install 'lad-study[cluster]'"
        ) from None
    try:
        client = Client(scheduler, timeout=PATIENCE_S)
    except (OSError, ValueError) as error:
        raise InputError(
            f"--scheduler: no Dask scheduler answers at {scheduler!r} ({type(error).__name__}); "
            "allowed: an address like tcp://host:8786"
        ) from None
    with client:
        yield
