"""What a part raised, in a few words and with the line where it did."""

import traceback
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Fault:
    """Something was raised.

    Attributes
    ----------
    lap
        In which lap, counted from 0.
    where
        At which point, in words.
    what
        The error, and its place in the code.
    """

    lap: int
    where: str
    what: str

    def __str__(self) -> str:
        return f"{self.where} it raises {self.what}"


def described(error: BaseException) -> str:
    """Return an error's type, message and place.

    Examples
    --------
    >>> described(ValueError("no"))
    'ValueError: no'
    """
    text = f"{type(error).__name__}: {error}".rstrip(": ")
    trace = traceback.extract_tb(error.__traceback__)
    return f"{text} ({Path(trace[-1].filename).name}:{trace[-1].lineno})" if trace else text
