"""The steps a model was taught, kept whole so that another model can be taught them again."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from lad.errors import ModelFileError
from lad.window import Window

Floats = NDArray[np.float64]
PREFIX = "taught/"


@dataclass
class TaughtSteps:
    """Every step that was learnt, with the window it was learnt in.

    Windows are kept whole, not rebuilt from consecutive inputs: taught steps need not be
    consecutive, and the memory of each is then what it was.

    Attributes
    ----------
    windows
        Each of shape (tau, d), newest input first, in the inputs' units.
    targets
        What the regressor learnt, one per output; None where no help was given.
    times, laps
        When in the model's life each step was seen.
    """

    windows: list[Floats] = field(default_factory=list)
    targets: list[Command | None] = field(default_factory=list)
    times: list[int] = field(default_factory=list)
    laps: list[int] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.windows)

    def add(self, window: Window, target: Command | None) -> None:
        """Keep the step that the window shows now."""
        self.windows.append(window.inputs)
        self.targets.append(target)
        self.times.append(window.time)
        self.laps.append(window.lap)

    @property
    def helped(self) -> NDArray[np.bool_]:
        """Shape (n,): whether help was given."""
        return np.array([target is not None for target in self.targets], dtype=np.bool_)

    def stacked(self) -> Floats:
        """Return all windows, shape (n, tau, d)."""
        return np.array(self.windows)

    def commands(self) -> Floats:
        """Return the targets of the steps with help, shape (helped, 2)."""
        return np.array([t for t in self.targets if t is not None]).reshape(-1, 2)

    def forget_before(self, lap: int) -> int:
        """Drop the steps of laps before this one; return how many were dropped."""
        kept = [i for i, of in enumerate(self.laps) if of >= lap]
        dropped = len(self) - len(kept)
        for name in ("windows", "targets", "times", "laps"):
            values = getattr(self, name)
            setattr(self, name, [values[i] for i in kept])
        return dropped

    def to_arrays(self) -> dict[str, NDArray[Any]]:
        """Take them apart for a saved model; NaN stands where no help was given."""
        missing = (np.nan, np.nan)
        targets = [missing if t is None else t for t in self.targets]
        return {
            f"{PREFIX}windows": self.stacked(),
            f"{PREFIX}helped": self.helped.astype(np.int8),
            f"{PREFIX}targets": np.nan_to_num(np.array(targets).reshape(-1, 2)),
            f"{PREFIX}times": np.array(self.times, dtype=np.int64),
            f"{PREFIX}laps": np.array(self.laps, dtype=np.int64),
        }

    @classmethod
    def from_arrays(cls, arrays: dict[str, NDArray[Any]]) -> "TaughtSteps":
        """Rebuild them.

        Raises
        ------
        ModelFileError
            When an array is missing or their lengths differ.
        """
        names = ("windows", "helped", "targets", "times", "laps")
        missing = [name for name in names if PREFIX + name not in arrays]
        if missing:
            raise ModelFileError(f"array {PREFIX + missing[0]!r} is missing")
        found = {name: arrays[PREFIX + name] for name in names}
        if len({len(array) for array in found.values()}) != 1:
            raise ModelFileError("the taught steps' arrays differ in length")
        pairs = zip(found["targets"].tolist(), found["helped"].tolist(), strict=True)
        return cls(
            list(found["windows"]),
            [Command(*target) if helped else None for target, helped in pairs],
            found["times"].tolist(),
            found["laps"].tolist(),
        )


def spread_out(n: int, most: int) -> NDArray[np.intp]:
    """Return at most so many of n indices, evenly spread from the first to the last.

    Examples
    --------
    >>> spread_out(10, 4).tolist()
    [0, 3, 6, 9]
    >>> spread_out(3, 4).tolist()
    [0, 1, 2]
    """
    if n <= most:
        return np.arange(n)
    return np.linspace(0, n - 1, most).round().astype(np.intp)
