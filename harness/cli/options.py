"""What options of several commands have in common."""

import os

from protocols.files.errors import InputError


def cores() -> int:
    """Return how many cores this process may use: a batch system may allow fewer than there are."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def check_least(option: str, value: int, least: int) -> None:
    """Refuse a number that is too small.

    Raises
    ------
    InputError
        Names the option and what is allowed.
    """
    if value < least:
        raise InputError(f"{option}: {value} is out of range; allowed: {least} or more")
