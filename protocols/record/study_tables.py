"""The tables of a study directory, each read once, joined with one another and with the plan."""

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import pyarrow as pa

from protocols.files.errors import InputError
from protocols.record.elsewhere.conform import Conformed, conform
from protocols.record.elsewhere.joined import (
    doubtful_times,
    joined_answers,
    joined_laps,
    with_practice,
)
from protocols.record.elsewhere.people import twins
from protocols.record.elsewhere.rules import LAPS, PARTICIPANTS, SURVEYS, TableRules
from protocols.record.header import StudyHeader
from protocols.record.merge import LAPS_TABLE, PARTICIPANTS_TABLE, SURVEYS_TABLE
from protocols.record.parquet import read_parquet


@dataclass(frozen=True)
class StudyTables:
    """Participants, laps and answers, and what was repaired on reading them.

    Nothing is read before it is asked for.
    """

    folder: Path
    header: StudyHeader

    @property
    def elsewhere(self) -> bool:
        """Whether other programs wrote them."""
        return self.header.origin == "elsewhere"

    @cached_property
    def participants(self) -> Conformed:
        """One row per participant."""
        return self._table(PARTICIPANTS_TABLE, PARTICIPANTS)

    @cached_property
    def laps(self) -> Conformed:
        """One row per lap begun; each says whether it is practice."""
        path, protocol = self.folder / LAPS_TABLE, self.header.protocol
        laps = self._table(LAPS_TABLE, LAPS)
        if self.elsewhere:
            laps = joined_laps(laps, self.participants.table, protocol, path)
        return with_practice(laps, protocol, path)

    @cached_property
    def surveys(self) -> Conformed:
        """One row per question asked; without rows when nothing was asked."""
        path, protocol = self.folder / SURVEYS_TABLE, self.header.protocol
        if self.elsewhere and not path.exists():
            nothing = pa.schema([pa.field(c.name, c.type) for c in SURVEYS.columns]).empty_table()
            return Conformed(conform(nothing, SURVEYS, path).table, self._unanswered("not there"))
        answers = self._table(SURVEYS_TABLE, SURVEYS)
        if not self.elsewhere:
            return answers
        if not len(answers.table):
            answers = Conformed(answers.table, self._unanswered("without a row"))
        return joined_answers(answers, self.laps.table, self.participants.table, protocol, path)

    @cached_property
    def people(self) -> list[str]:
        """Ids of the participants, in the table's order."""
        ids: list[str] = self.participants.table["participant"].to_pylist()
        return ids

    @cached_property
    def lap_numbers(self) -> dict[str, list[int]]:
        """Numbers of each participant's laps."""
        numbers: dict[str, list[int]] = {}
        table = self.laps.table
        rows = zip(*(table[c].to_pylist() for c in ("participant", "lap")), strict=True)
        for who, lap in rows:
            numbers.setdefault(who, []).append(lap)
        return numbers

    @cached_property
    def remarks(self) -> tuple[str, ...]:
        """What was recognised although it is written otherwise, in words."""
        found = [*self.participants.remarks, *self.laps.remarks]
        if self.elsewhere:
            found += doubtful_times(self.laps.table)
            if alike := twins(self.people):
                found.append(f"participants.parquet: {', '.join(alike)} look alike: one person?")
        with suppress(InputError):  # said where the answers are read
            found += self.surveys.remarks
        return tuple(found)

    def _unanswered(self, why: str) -> tuple[str, ...]:
        """Return in words that there is no answer; nothing where nothing was to be asked."""
        asked = bool(self.header.instruments)
        return (f"{SURVEYS_TABLE}: {why}, and the study has questions",) if asked else ()

    def _table(self, name: str, rules: TableRules) -> Conformed:
        path = self.folder / name
        if not path.exists():
            again = "; the same `lad-study run` again finishes the study"
            raise InputError(f"{path}: no such file{'' if self.elsewhere else again}")
        return conform(read_parquet(path), rules, path)
