"""One thing that was looked at, and what it stops."""

from dataclasses import dataclass
from typing import Literal, get_args

Purpose = Literal["run", "live", "cluster", "export", "video"]
"""What somebody may want to do: ``run`` is simulate and report, ``export`` also ``import bag``."""

PURPOSES: tuple[Purpose, ...] = get_args(Purpose)


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was looked at.

    Attributes
    ----------
    what
        What was looked at.
    found
        What is there, in a few words.
    stops
        What cannot be done because of it; empty where all is well.
    mend
        The line that puts it right, or what to do; "" where nothing has to be done.
    """

    what: str
    found: str
    stops: tuple[Purpose, ...] = ()
    mend: str = ""
