"""What of a study is exported: its tables without what could tell who took part."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import pyarrow as pa
import pyarrow.compute as pc

from analysis.export.field import Field, field_of
from analysis.export.file_labels import file_labels
from analysis.export.known import WRITTEN, known_words, of_the_study
from analysis.export.privacy import (
    INCLUDES,
    exported_ids,
    minimised,
    only_known,
    unique_people,
)
from analysis.export.sharing import (
    SYNTHETIC,
    Licence,
    check_sharing,
    has_living,
    licence_of,
    may_be_shared,
)
from lad.inputs import N_SEGMENTS
from protocols.files.errors import InputError
from protocols.record.column import Column
from protocols.record.reader import Study
from protocols.record.steps import STEP_COLUMNS
from protocols.record.tables import LAP_COLUMNS, PARTICIPANT_COLUMNS, SURVEY_COLUMNS

_F = pa.float64()

_PLAIN_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,79}")

_ITEM_COLUMNS = (
    Column("instrument", pa.string(), "Instrument as the protocol names it"),
    Column("item", pa.string(), "Item of the instrument, e.g. Q7"),
    Column("text", pa.string(), "Wording, as the person reads it"),
    Column("subscale", pa.string(), "Composite the item belongs to"),
    Column("reverse", pa.bool_(), "Whether agreement means less of what the subscale measures"),
    Column("answer", pa.string(), "How it is answered", "", "point, number, text"),
    Column("points", pa.int16(), "Points of the scale, counted from 1", "", "2 or more"),
    Column("labels", pa.string(), "Labels of the points, from 1 upwards, divided by ' | '"),
)


class Table(NamedTuple):
    """A table and what its columns are; ``key`` names the columns that together name a row."""

    name: str
    rows: pa.Table
    fields: tuple[Field, ...]
    key: tuple[str, ...]
    description: str


class LapSteps(NamedTuple):
    """A lap's row by column name, and its steps."""

    lap: dict[str, object]
    steps: pa.Table


@dataclass(frozen=True)
class Content:
    """A study as it is handed on. Steps are read lap by lap, so that memory does not grow.

    Attributes
    ----------
    study
        Where it comes from.
    licence
        Under what.
    include
        Names in ``privacy.INCLUDES`` that are kept.
    """

    study: Study
    licence: Licence
    include: frozenset[str] = frozenset()

    @property
    def name(self) -> str:
        """Name of the study: lower case, digits, ``-`` and ``_``."""
        name = self.study.protocol.name.lower().replace(" ", "-")
        return "".join(c for c in name if c.isalnum() or c in "-_")

    @cached_property
    def living(self) -> bool:
        """Whether living people took part."""
        return has_living(self.study)

    @cached_property
    def ids(self) -> dict[str, str]:
        """Ids as exported, by recorded ids, of the participants whose consent covers it."""
        table = self.study.participants
        kept = table.filter(may_be_shared(self.study, living=self.living))
        recorded: list[str] = kept["participant"].to_pylist()
        if "ids" in self.include:
            return {name: name for name in recorded}
        return exported_ids(recorded)

    @cached_property
    def people(self) -> tuple[str, ...]:
        """Participants whose consent covers it, as exported, sorted."""
        return tuple(sorted(self.ids.values()))

    @cached_property
    def labels(self) -> dict[str, str]:
        """The names of the people as file names have them; no two are the same."""
        return file_labels(self.people)

    @cached_property
    def participants(self) -> Table:
        """One row per participant; traits in a column each."""
        table, columns = self._shared(self.study.participants, PARTICIPANT_COLUMNS)
        table, columns = _traits_apart(table, columns)
        text = "One row per participant"
        return self._table("participants", table, columns, ("participant",), text)

    @cached_property
    def laps(self) -> Table:
        """One row per lap begun."""
        table, columns = self._shared(self.study.laps, LAP_COLUMNS)
        table, columns = _segments_apart(table, columns)
        return self._table("laps", table, columns, ("participant", "lap"), "One row per lap begun")

    @cached_property
    def surveys(self) -> Table:
        """One row per question asked."""
        table, columns = self._shared(self.study.surveys, SURVEY_COLUMNS)
        key = ("participant", "lap", "instrument", "item")
        return self._table("surveys", table, columns, key, "One row per question asked")

    @cached_property
    def items(self) -> Table:
        """The questions: one row per item of an instrument."""
        rows = [
            {
                "instrument": instrument.name,
                "item": item.id,
                "text": item.text,
                "subscale": item.subscale,
                "reverse": item.reverse,
                "answer": item.answer,
                "points": instrument.points,
                "labels": " | ".join(instrument.anchors),
            }
            for instrument in self.study.instruments
            for item in instrument.items
        ]
        schema = pa.schema([(column.name, column.type) for column in _ITEM_COLUMNS])
        table = pa.Table.from_pylist(rows, schema=schema)
        return self._table("items", table, _ITEM_COLUMNS, ("instrument", "item"), "The questions")

    @cached_property
    def step_fields(self) -> tuple[Field, ...]:
        """Columns of the steps: participant and lap, then those of the record."""
        return (*self.laps.fields[:2], *self._fields(STEP_COLUMNS))

    def laps_with_steps(self) -> Iterator[LapSteps]:
        """Yield every lap whose steps were recorded, in the order of participants and laps."""
        recorded = {exported: name for name, exported in self.ids.items()}
        for part in self.laps.rows.to_batches(max_chunksize=100):
            for lap in part.to_pylist():
                if self.study.has_steps(recorded[lap["participant"]], lap["lap"]):
                    yield LapSteps(lap, self._steps(recorded[lap["participant"]], lap["lap"]))

    @cached_property
    def _known_words(self) -> dict[str, frozenset[str]]:
        """Words that columns may hold: another program's may hold anything."""
        if not self.study.elsewhere:
            return {}
        kept = WRITTEN if "words" in self.include else frozenset[str]()
        return {name: w for name, w in known_words(self.study).items() if name not in kept}

    @cached_property
    def unique_people(self) -> int:
        """How many people nobody else equals in age, gender and handedness, as exported."""
        return unique_people(self.participants.rows)

    def _steps(self, participant: str, lap: int) -> pa.Table:
        table = self.study.steps(participant, lap).select([c.name for c in STEP_COLUMNS])
        table, count = only_known(table, self._known_words), len(table)
        exported = pa.scalar(self.ids[participant], pa.string())
        keys = (pa.repeat(exported, count), pa.repeat(pa.scalar(lap, pa.int16()), count))
        names = ["participant", "lap", *table.column_names]
        return pa.table(dict(zip(names, [*keys, *map(_whole, table.columns)], strict=True)))

    def _shared(
        self, table: pa.Table, columns: tuple[Column, ...]
    ) -> tuple[pa.Table, tuple[Column, ...]]:
        ours = table.filter(pc.is_in(table["participant"], pa.array(list(self.ids), pa.string())))
        exported = [self.ids[name] for name in ours["participant"].to_pylist()]
        at = ours.schema.get_field_index("participant")
        ours = ours.set_column(at, ours.schema.field(at), pa.array(exported, pa.string()))
        if self.study.elsewhere:
            ours = only_known(of_the_study(ours, self.study), self._known_words)
        order = [(n, "ascending") for n in ("participant", "lap") if n in ours.column_names]
        # Stable: the questions of a lap stay in the order in which they were asked.
        keyed = ours.append_column("_row", pa.array(range(len(ours)), pa.int64()))
        indices = pc.sort_indices(keyed, sort_keys=[*order, ("_row", "ascending")])
        return minimised(ours.take(indices), columns, self.include)

    def _table(
        self,
        name: str,
        table: pa.Table,
        columns: tuple[Column, ...],
        key: tuple[str, ...],
        description: str,
    ) -> Table:
        fields = self._fields(columns)
        arrays = [
            _whole(table[f.name].cast(f.type) if table[f.name].type != f.type else table[f.name])
            for f in fields
        ]
        rows = pa.table(dict(zip([f.name for f in fields], arrays, strict=True)))
        return Table(name, rows, fields, key, description)

    def _fields(self, columns: tuple[Column, ...]) -> tuple[Field, ...]:
        fields = tuple(map(field_of, columns))
        if not self.study.elsewhere:
            return fields
        # Other programs need not have recorded more than the keys.
        keys = {"participant", "lap", "condition", "instrument", "item"}
        return tuple(f if f.name in keys else _may_be_missing(f) for f in fields)


def content_of(
    study: Study, licence: str | None = None, include: frozenset[str] = frozenset()
) -> Content:
    """Return what of a study may be handed on.

    Parameters
    ----------
    study
        The study.
    licence
        As a person gave it (``sharing.licence_of``).
    include
        Names in ``privacy.INCLUDES``.

    Raises
    ------
    InputError
        When living people took part and there is no licence, or no consent that allows it.
    """
    check_sharing(study)
    content = Content(study, licence_of(licence, living=has_living(study)), include)
    if not content.people:
        raise InputError(f"{study.folder}: nobody's consent is on record; nothing can be exported")
    return content


def left_out(content: Content) -> tuple[str, ...]:
    """Return in words what is not in the export and could be added."""
    return tuple(INCLUDES[name] for name in INCLUDES if name not in content.include)


def _may_be_missing(field: Field) -> Field:
    return replace(field, nullable=True)


def _whole(array: pa.ChunkedArray | pa.Array) -> pa.ChunkedArray | pa.Array:
    """Return an array with missing values where other programs recorded NaN or infinity."""
    if not pa.types.is_floating(array.type):
        return array
    return pc.if_else(pc.is_finite(array), array, None)


def _traits_apart(
    table: pa.Table, columns: tuple[Column, ...]
) -> tuple[pa.Table, tuple[Column, ...]]:
    """Put every trait into a column of its own."""
    made_up = pc.is_in(table["kind"], pa.array(SYNTHETIC, pa.string())).to_pylist()
    people = [
        dict(traits or ()) if synthetic else {}
        for traits, synthetic in zip(table["traits"].to_pylist(), made_up, strict=True)
    ]
    # A name becomes a column's, and a part of the script for R.
    names = sorted({name for traits in people for name in traits if _PLAIN_NAME.fullmatch(name)})
    apart = tuple(
        Column(f"trait_{name}", _F, f"Trait of a synthetic person: {name}", nullable=True)
        for name in names
    )
    arrays = [pa.array([traits.get(name) for traits in people], _F) for name in names]
    return _instead(table, columns, "traits", apart, arrays)


def _segments_apart(
    table: pa.Table, columns: tuple[Column, ...]
) -> tuple[pa.Table, tuple[Column, ...]]:
    """Put every laser segment after the last step into a column of its own."""
    scans = table["last_segments"].to_pylist()
    apart = tuple(
        Column(f"last_segment_{i:02d}", _F, f"Laser segment {i} of {N_SEGMENTS} after the last "
               "step", "m", "0 to 4", nullable=True)
        for i in range(N_SEGMENTS)
    )  # fmt: skip
    arrays = [pa.array([s[i] if s else None for s in scans], _F) for i in range(N_SEGMENTS)]
    return _instead(table, columns, "last_segments", apart, arrays)


def _instead(
    table: pa.Table,
    columns: tuple[Column, ...],
    name: str,
    new: tuple[Column, ...],
    arrays: list[pa.Array],
) -> tuple[pa.Table, tuple[Column, ...]]:
    at = [column.name for column in columns].index(name)
    names = [c.name for c in (*columns[:at], *new, *columns[at + 1 :])]
    there = {c.name: table[c.name] for c in columns if c.name != name}
    there |= dict(zip([c.name for c in new], arrays, strict=True))
    return pa.table({n: there[n] for n in names}), (*columns[:at], *new, *columns[at + 1 :])
