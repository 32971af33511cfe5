"""Find who answered what, and turn it into points of the instrument's scale."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from protocols.files.errors import InputError
from protocols.files.suggestion import allowed, listed
from protocols.importing.answers.mapping import AnswersMapping
from protocols.importing.answers.sheet import Sheet
from protocols.instrument import Instrument, Item

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)", re.ASCII)
_WITH_COMMA = re.compile(r"[+-]?(\d{1,3}(\.\d{3})+|\d+)?(,\d*)?", re.ASCII)
"""Points divide thousands where a comma divides decimals; ``1.5`` is no number then."""

Key = tuple[str, int, str]
"""Participant, lap and item."""


class Given(NamedTuple):
    """An answer as text, and where it stands."""

    key: Key
    text: str
    where: str


@dataclass(frozen=True, slots=True)
class Matched:
    """Answers that were found.

    Attributes
    ----------
    answers
        By participant, lap and item; None where the file says that there is none.
    unmatched
        What of the file belongs to nothing in the study, in words.
    """

    answers: dict[Key, float | str | None]
    unmatched: tuple[str, ...]


def match(
    sheet: Sheet, mapping: AnswersMapping, instrument: Instrument, people: frozenset[str]
) -> Matched:
    """Return every answer that belongs to somebody in the study.

    Parameters
    ----------
    sheet
        The file.
    mapping
        What is where in it.
    instrument
        What was asked.
    people
        The study's participants.

    Raises
    ------
    InputError
        When a column of the mapping is not there, a label is not known, a number is no point of
        the scale, or a question was answered twice; names line, column and what is allowed.
    """
    _check_columns(sheet, mapping)
    reading = _Reading(sheet, mapping, instrument)
    given = list(_wide(reading) if mapping.wide else _long(reading))
    strangers = sorted({g.key[0] for g in given} - people)
    answers: dict[Key, float | str | None] = {}
    for one in given:
        if one.key[0] not in people:
            continue
        if answers.get(one.key) is not None and mapping.doubled == "refuse":
            participant, lap, item = one.key
            raise InputError(
                f"{one.where}: {participant} answered {item} after lap {lap} before; allowed: one "
                "answer, or 'doubled: last' in the mapping"
            )
        answers[one.key] = reading.value(one)
    words = [*reading.unmatched, *(f"{name} is not in the study" for name in strangers)]
    return Matched(answers, tuple(dict.fromkeys(words)))


def _check_columns(sheet: Sheet, mapping: AnswersMapping) -> None:
    wanted = {mapping.participant.column, *(drop.column for drop in mapping.drop)}
    if mapping.long:
        lap = mapping.long.lap
        wanted |= {mapping.long.item, mapping.long.answer, *([lap] if isinstance(lap, str) else [])}
    for name in sorted(wanted - set(sheet.names)):
        raise InputError(f"{sheet.path}:1: no column {name!r}; {allowed(name, sheet.names)}")


class _Reading:
    """A file while it is read, and what of it belongs to nothing."""

    def __init__(self, sheet: Sheet, mapping: AnswersMapping, instrument: Instrument) -> None:
        self.sheet, self.mapping, self.instrument = sheet, mapping, instrument
        self.unmatched: list[str] = []
        anchors = {text: i for i, text in enumerate(instrument.anchors, start=1)}
        labels = anchors if mapping.labels == "anchors" else mapping.labels
        self._labels = {label.casefold(): point for label, point in labels.items()}

    def rows(self) -> Iterator[tuple[str, str, dict[str, str]]]:
        """Yield where each row stands, who answered, and the row; those to drop are passed over."""
        dropped = 0
        for line, row in self.sheet.rows:
            if any(row[drop.column] in drop.values for drop in self.mapping.drop):
                dropped += 1
                continue
            who = row[self.mapping.participant.column]
            where = f"{self.sheet.path}:{line}"
            if not who:
                self.unmatched.append(f"line {line} does not say who answered")
                continue
            yield where, self.mapping.participant.ids.get(who, who), row
        if dropped:
            self.unmatched.append(f"{dropped} rows were dropped, as the mapping says")

    def item(self, name: str) -> Item | None:
        """Return the item that the file calls so; None when there is none."""
        try:
            return self.instrument.item(self.mapping.items.get(name, name))
        except KeyError:
            return None

    def lap(self, text: str, where: str) -> int:
        """Return a lap's position in the session, counted from 0."""
        if not text.isdecimal() or int(text) < self.mapping.first_lap:
            least = self.mapping.first_lap
            raise InputError(f"{where}: {text!r} is no lap; allowed: {least} or more")
        return int(text) - self.mapping.first_lap

    def value(self, given: Given) -> float | str | None:
        """Return an answer as the record has it.

        Raises
        ------
        InputError
            When it is neither a known label nor a number that is allowed.
        """
        item = self.instrument.item(given.key[2])
        if given.text in self.mapping.missing:
            return None
        if item.answer == "text":
            return given.text
        number = self._number(given.text)
        if item.answer == "number":
            if number is None:
                raise InputError(f"{given.where}: {given.text!r} is no number")
            return number
        points = self.instrument.points
        point = self._labels.get(given.text.casefold(), number)
        if point is None or point != int(point) or not 1 <= point <= points:
            known = ", ".join(self._labels) or "no label"
            raise InputError(
                f"{given.where}: {given.text!r} is no answer to {item.id}; allowed: 1 to {points}, "
                f"{known}, or what 'missing' lists"
            )
        return points + 1 - int(point) if item.id in self.mapping.reversed else int(point)

    def _number(self, text: str) -> float | None:
        if self.mapping.decimal == ",":
            if not _WITH_COMMA.fullmatch(text):
                return None
            text = text.replace(".", "").replace(",", ".")
        return float(text) if _NUMBER.fullmatch(text) else None


def _wide(reading: _Reading) -> Iterator[Given]:
    wide = reading.mapping.wide
    if wide is None:  # pragma: no cover - the caller looked
        return
    pattern = wide.pattern()
    columns: list[tuple[str, int, str]] = []
    for name in reading.sheet.names:
        found = pattern.fullmatch(name)
        item = reading.item(found["item"]) if found else None
        if found is None or item is None:
            if name != reading.mapping.participant.column:
                reading.unmatched.append(f"column {name!r} is no item of {reading.instrument.name}")
            continue
        where = f"{reading.sheet.path}:1: column {name!r}"
        lap = wide.lap if wide.lap is not None else reading.lap(found["lap"], where)
        columns.append((name, lap, item.id))
    if not columns:
        raise InputError(
            f"{reading.sheet.path}:1: no column is like {wide.columns!r}; "
            f"{listed([n for n in reading.sheet.names if n])} are there"
        )
    for where, who, row in reading.rows():
        for name, lap, item_id in columns:
            yield Given((who, lap, item_id), row[name], f"{where}: column {name!r}")


def _long(reading: _Reading) -> Iterator[Given]:
    long = reading.mapping.long
    if long is None:  # pragma: no cover - the caller looked
        return
    for where, who, row in reading.rows():
        item = reading.item(row[long.item])
        if item is None:
            reading.unmatched.append(
                f"item {row[long.item]!r} is not one of {reading.instrument.name}"
            )
            continue
        place = f"{where}: column {long.lap!r}"
        lap = long.lap if isinstance(long.lap, int) else reading.lap(row[long.lap], place)
        yield Given((who, lap, item.id), row[long.answer], f"{where}: column {long.answer!r}")
