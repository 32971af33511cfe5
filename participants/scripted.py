"""A driver that replays a recorded command log."""

import csv
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lad.command import STILL, Command
from participants.driver import ParticipantKind
from participants.options import Options, read_options
from participants.setup import DriverSetup
from participants.sight import Sight
from protocols.files.errors import InputError

COLUMNS = ("t_s", "v_m_s", "w_rad_s")
"""Columns of a command log; it may have others, which are not read."""

ALLOWED = f"allowed: a CSV file with columns {', '.join(COLUMNS)}, times rising from 0 or more"


class ScriptedOptions(Options):
    """What a protocol may set for a scripted driver: exactly one of the two.

    Attributes
    ----------
    file
        A CSV file with columns ``t_s``, ``v_m_s`` and ``w_rad_s``; relative to the protocol file.
    commands
        The same as a list of rows ``[t, v, w]``, in s, m/s and rad/s.
    """

    file: str | None = None
    commands: Annotated[list[tuple[float, float, float]], Field(min_length=1)] | None = None

    @model_validator(mode="after")
    def _one_of_them(self) -> Self:
        if (self.file is None) == (self.commands is None):
            raise ValueError("give either file or commands")
        return self


class ScriptedDriver:
    """Gives in every lap the log's command for that time; after its end, the chair stands.

    Parameters
    ----------
    log
        Shape (n, 3): times in s, rising; commands in m/s and rad/s. Each command is in force until
        the next one; before the first, the chair stands.
    where
        Where the log comes from, for the message.

    Raises
    ------
    InputError
        When the log has another shape, holds no finite numbers, or times that do not rise.

    Examples
    --------
    >>> ScriptedDriver([(0.0, 0.5, 0.0), (2.0, 0.0, 0.0)]).command_at(1.9)
    Command(v=0.5, w=0.0)
    """

    kind: ParticipantKind = "scripted"

    def __init__(self, log: ArrayLike, where: str = "command log") -> None:
        self._log = _checked(log, where)

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Start the log again; nothing is random."""

    def act(self, sight: Sight) -> Command:
        """Return the log's command for now, whatever there is to see."""
        return self.command_at(sight.t)

    def command_at(self, t: float) -> Command:
        """Return the command that is in force at a time, s."""
        row = int(np.searchsorted(self._log[:, 0], t + 1e-9, side="right")) - 1
        if row < 0:
            return STILL
        return Command(float(self._log[row, 1]), float(self._log[row, 2]))


def read_log(path: Path) -> NDArray[np.float64]:
    """Read a command log.

    Parameters
    ----------
    path
        A CSV file with a header that names ``COLUMNS``.

    Returns
    -------
    NDArray
        Shape (n, 3).

    Raises
    ------
    InputError
        When the file cannot be read, lacks a column, or holds something that is not a number; with
        the line.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            lines = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "it is not text in CSV form"
        raise InputError(f"{path}: cannot be read as a command log ({reason}); {ALLOWED}") from None
    header = [name.strip() for name in lines[0]] if lines else []
    missing = [name for name in COLUMNS if name not in header]
    if missing:
        raise InputError(f"{path}:1: column {', '.join(missing)} is missing; {ALLOWED}")
    places = [header.index(name) for name in COLUMNS]
    rows = [_row(line, places, f"{path}:{n}") for n, line in enumerate(lines[1:], 2) if any(line)]
    if not rows:
        raise InputError(f"{path}: holds no command; {ALLOWED}")
    return np.array(rows)


def _row(line: Sequence[str], places: Sequence[int], where: str) -> tuple[float, ...]:
    try:
        return tuple(float(line[place]) for place in places)
    except IndexError:
        raise InputError(f"{where}: has only {len(line)} values; {ALLOWED}") from None
    except ValueError as error:
        raise InputError(f"{where}: {error}; {ALLOWED}") from None


def _checked(log: ArrayLike, where: str) -> NDArray[np.float64]:
    try:
        rows = np.array(log, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{where}: rows of numbers t, v, w are needed") from None
    if rows.ndim != 2 or rows.shape[1] != len(COLUMNS) or not len(rows):
        raise InputError(f"{where}: has shape {rows.shape}; allowed: (n, 3), n at least 1")
    wrong = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(wrong):
        raise InputError(f"{where}: command {wrong[0] + 1} is not finite; {ALLOWED}")
    back = np.flatnonzero(np.diff(rows[:, 0], prepend=-math.inf) <= 0.0)
    if rows[0, 0] < 0 or len(back):
        at = 0 if rows[0, 0] < 0 else back[0]
        raise InputError(f"{where}: command {at + 1} comes at {rows[at, 0]:g} s; {ALLOWED}")
    return rows


def scripted_driver(setup: DriverSetup) -> ScriptedDriver:
    """Return a driver that replays what its options name; see ``ScriptedOptions``."""
    options = read_options("driver 'scripted'", ScriptedOptions, setup.options)
    if options.file is None:
        return ScriptedDriver(options.commands or [], "driver 'scripted': commands")
    path = (setup.folder or Path()) / options.file
    return ScriptedDriver(read_log(path), str(path))


def portable_options(options: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Return options that do not need the command log's file any more: it is read here and now.

    Sessions may run on machines that do not have the file, and the study directory still contains
    the commands when the file is gone.

    Raises
    ------
    InputError
        When the file cannot be read, or its log not be replayed.
    """
    if set(options) != {"file"}:
        return dict(options)
    path = folder / str(options["file"])
    log = read_log(path)
    ScriptedDriver(log, str(path))  # refuses, by the file's name, what it could not replay
    return {"commands": log.tolist()}
