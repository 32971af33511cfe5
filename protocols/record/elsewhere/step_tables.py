"""The step tables of a study that other programs recorded, matched with its laps."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from protocols.files.errors import InputError
from protocols.record.elsewhere.clock import NOT_INCREASING, lap_clock
from protocols.record.elsewhere.conform import Conformed, conform
from protocols.record.elsewhere.folders import folders_by_person, lap_shift, strays, unusable_names
from protocols.record.elsewhere.placement import INCOMPLETE, Floor, Placement
from protocols.record.elsewhere.rules import STEPS
from protocols.record.elsewhere.whose import (
    LOOKED_AT,
    Key,
    LapRow,
    Told,
    helpers,
    misfiled,
    not_planned,
    told_by,
)
from protocols.record.parquet import read_parquet
from protocols.record.session import steps_file
from protocols.record.sessions import SESSIONS, session_folders
from protocols.record.steps import STEP_COLUMNS
from protocols.record.study_tables import StudyTables

_IN_EVERY_STEP = tuple(column.name for column in STEP_COLUMNS if not column.nullable)
_TIMES = replace(STEPS, required=("t_s",))
NO_ROW = "the table has no row"
"""What is said of a step table in which nothing is recorded."""
_MAYBE = "another lap's table, or some steps cut? They are used"
UNLIKE = f"the times end up to 1 s or 5% off the lap's own: a clock started by hand, {_MAYBE}"
"""What is said of a step table that lasts longer or shorter than its lap by more than a step or two
and by less than a contradiction."""
OTHER_NUMBER = f"there are more or fewer than the lap's row says: {_MAYBE}"
"""What is said of a step table that has another number of steps than its lap."""


class LapSteps(NamedTuple):
    """A lap's steps as they can be used, and what was found about them.

    Attributes
    ----------
    table
        Columns of ``protocols.record.steps.STEP_COLUMNS``, then any others.
    remarks
        What was repaired, or is missing because it contradicts the lap, in words.
    placement
        Whether the positions are on the course; taken for granted in a study of our own.
    """

    table: pa.Table
    remarks: tuple[str, ...] = ()
    placement: Placement = Placement(on_course=True)


class _Lasted(NamedTuple):
    """Whether a lap was finished, and how long it took by any column that says so, s."""

    finished: bool = False
    seconds: tuple[float, ...] = ()


@dataclass(frozen=True)
class ForeignSteps:
    """Where the step tables of a study from elsewhere are, and how they are to be read."""

    tables: StudyTables

    @cached_property
    def folders(self) -> dict[str, Path]:
        """Each participant's session folder, of those who have one."""
        return folders_by_person(session_folders(self.tables.folder), self.tables.people)

    @cached_property
    def shift(self) -> int:
        """What to subtract from a lap's number for its step table's."""
        laps = self.tables.lap_numbers
        return lap_shift({path: laps.get(who, ()) for who, path in self.folders.items()})

    @cached_property
    def strays(self) -> tuple[str, ...]:
        """Step tables that no lap refers to, in words."""
        laps = self.tables.lap_numbers
        owners = {
            path: (who, {n - self.shift for n in laps.get(who, ())})
            for who, path in self.folders.items()
        }
        found = list(strays(self.tables.folder / SESSIONS, owners, self.tables.people))
        if odd := unusable_names(self.tables.people):
            found.append(
                f"steps of people of whose id no folder can have the name ({', '.join(odd[:5])})"
            )
        return tuple(found)

    @cached_property
    def remarks(self) -> tuple[str, ...]:
        """What was repaired for all of them, in words."""
        said = "step tables are counted from 0, laps from 1: matched in their order"
        return (said,) if self.shift else ()

    def used(self, steps: Conformed, participant: str, lap: int, *, against_lap: bool) -> LapSteps:
        """Return a lap's steps with times from its start, and where its positions lie.

        Parameters
        ----------
        steps
            As they were read.
        participant, lap
            Of which lap.
        against_lap
            Whether times are missing that contradict how long the lap took.

        Raises
        ------
        InputError
            When the table says of itself that it is another lap's.
        """
        if (participant, lap) in self.misfiled:
            path = self.path(participant, lap)
            raise InputError(f"{path}: {self.misfiled[participant, lap]}")
        lasted = self._lasted.get((participant, lap), _Lasted())
        table = steps.table
        clock = lap_clock(_floats(table, "t_s"), lasted.seconds if against_lap else ())
        table = table.set_column(
            table.schema.get_field_index("t_s"), "t_s", pa.array(clock.t_s, from_pandas=False)
        )
        xy = np.column_stack([_floats(table, "x_m"), _floats(table, "y_m")])
        placement = self._floor.placement(xy, finished=lasted.finished)
        said = [remark.partition(": ")[2] for remark in steps.remarks]
        if not len(table):
            said.append(NO_ROW)
        if (np.diff(clock.t_s) <= 0).any():
            said.append(NOT_INCREASING)
        said += _missing(steps.table)
        if placement.on_course and not placement.whole:
            said.append(INCOMPLETE)
        row, told = self._rows.get((participant, lap)), self._tell.get((participant, lap))
        if row and (by := not_planned(table, row)):
            said.append(f"commands of the {by} count, and the lap's condition has no such help")
        if row and told and told.lasts(row) is False and np.isfinite(clock.t_s).any():
            said.append(UNLIKE if told.spans and row.lasted else OTHER_NUMBER)
        return LapSteps(table, (*clock.remarks, *said), placement)

    def path(self, participant: str, lap: int) -> Path | None:
        """Return a lap's step table; None where there is none."""
        folder = self.folders.get(participant)
        path = None if folder is None else folder / steps_file(lap - self.shift)
        return path if path is not None and path.is_file() else None

    @cached_property
    def misfiled(self) -> dict[Key, str]:
        """The step tables that are another lap's by what they say of themselves, in words."""
        return misfiled(self._rows, self._tell)

    @cached_property
    def _tell(self) -> dict[Key, Told]:
        """What each lap's step table says of itself, of those that can be read."""
        told = ((key, self._told(key)) for key in self._rows)
        return {key: said for key, said in told if said is not None}

    def _told(self, key: Key) -> Told | None:
        """Return what a lap's step table says of itself; None where it cannot be read."""
        path = self.path(*key)
        if path is None:
            return None
        try:
            table = conform(read_parquet(path, LOOKED_AT), _TIMES, path, LOOKED_AT).table
        except InputError:  # said where the table is read
            return None
        return told_by(table, _floats(table, "t_s")) if len(table) else None

    @cached_property
    def _rows(self) -> dict[Key, LapRow]:
        """What each lap's row says that its steps can be held against."""
        table, conditions = self.tables.laps.table, self.tables.header.protocol.conditions
        columns = ("participant", "lap", "condition", "steps")
        rows = zip(*(table[c].to_pylist() for c in columns), strict=True)
        return {
            (who, lap): LapRow(
                condition, helpers(conditions.get(condition)), self._lasted[who, lap].seconds, steps
            )
            for who, lap, condition, steps in rows
        }

    @cached_property
    def _floor(self) -> Floor:
        return Floor(self.tables.header.course)

    @cached_property
    def _lasted(self) -> dict[tuple[str, int], _Lasted]:
        columns = ("participant", "lap", "completed", "lap_time_s", "duration_s")
        rows = zip(*(self.tables.laps.table[c].to_pylist() for c in columns), strict=True)
        return {
            (who, lap): _Lasted(done, tuple(s for s in times if s and math.isfinite(s)))
            for who, lap, done, *times in rows
        }


def _missing(table: pa.Table) -> Iterator[str]:
    """Name the columns in which some steps have no value, where every step should have one.

    A column that is not recorded at all says nothing, except where a table must have it.
    """
    n = len(table)
    names = []
    for name in _IN_EVERY_STEP if n else ():
        column = table[name]
        if column.null_count == n and name not in STEPS.required:
            continue
        missing = pc.sum(pc.is_null(column, nan_is_null=True)).as_py()
        if missing == n and name in STEPS.required:
            yield f"no step has a value of {name}"
        elif 0 < missing < n:
            names.append(name)
    if names:
        shown = ", ".join(names[:5]) + (f", ... ({len(names)} in all)" if len(names) > 5 else "")
        yield f"some steps have no value of {shown}: measures are of the others, or missing"


def _floats(table: pa.Table, name: str) -> NDArray[np.float64]:
    return np.asarray(table[name].to_numpy(), dtype=np.float64)
