"""A fault in a file: where in its data, and what."""

from typing import NamedTuple

Location = tuple[str | int, ...]
"""Keys and indices from the top of the data to a value."""


class Fault(NamedTuple):
    """What is wrong, and in which field of the file."""

    where: Location
    message: str


class InconsistentError(ValueError):
    """Parts of a file contradict one another; ``faults`` has the places."""

    def __init__(self, faults: tuple[Fault, ...]) -> None:
        super().__init__("; ".join(fault.message for fault in faults))
        self.faults = faults
