"""Write the answers of a questionnaire export into a study that was recorded elsewhere."""

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from protocols.files.document import Document
from protocols.files.errors import InputError
from protocols.files.suggestion import allowed
from protocols.importing.answers.mapping import AnswersMapping
from protocols.importing.answers.matching import Key, match
from protocols.importing.answers.sheet import read_sheet
from protocols.importing.mapping_file import read_mapping
from protocols.instrument import Instrument
from protocols.laps import PlannedLap
from protocols.questions import asked_items
from protocols.record.atomic import write_whole
from protocols.record.merge import SURVEYS_TABLE
from protocols.record.parquet import parquet_bytes
from protocols.record.reader import Study, open_study
from protocols.record.rows import SurveyRow, response_fields
from protocols.record.tables import SURVEY_SCHEMA


@dataclass(frozen=True, slots=True)
class ImportedAnswers:
    """What became of a file.

    Attributes
    ----------
    rows
        How many questions are on record now, those of the file.
    answered
        How many of them have an answer.
    unmatched
        What of the file belongs to nothing in the study, and what of the study is not in the file,
        in words.
    """

    rows: int
    answered: int
    unmatched: tuple[str, ...]


def import_answers(file: Path, mapping_path: Path, study_dir: Path) -> ImportedAnswers:
    """Add the answers of one instrument to a study.

    Questions that the protocol asks and the file does not answer are recorded as not answered.
    Answers to other instruments stay, and of people who are not in the file; others are replaced.

    Parameters
    ----------
    file
        Questionnaire export (CSV).
    mapping_path
        What is where in it (``mapping.AnswersMapping``).
    study_dir
        A study that was recorded elsewhere.

    Raises
    ------
    InputError
        When something cannot be read or matched; names the place. The study is as it was then.
    """
    mapping, document = read_mapping(mapping_path, AnswersMapping)
    study = open_study(study_dir)
    if not study.elsewhere:
        raise InputError(
            f"{study_dir}: recorded its answers itself; allowed: a study with origin elsewhere"
        )
    instrument = _instrument(study, mapping, document)
    laps = {(row["participant"], row["lap"]): row["condition"] for row in study.laps.to_pylist()}
    people = frozenset(study.participants["participant"].to_pylist())
    found = match(read_sheet(file, mapping), mapping, instrument, people)
    there = {key[0] for key in found.answers}
    if not there:
        raise InputError(
            f"{file}: nobody in it is in the study; allowed: {', '.join(sorted(people))}, or "
            "'ids' in the mapping"
        )
    nowhere = sorted({key[:2] for key in found.answers} - laps.keys())
    planned = _planned(study, instrument)
    answers = dict.fromkeys(planned) | {
        key: value for key, value in found.answers.items() if key[:2] in laps
    }
    # A wide file has a cell for every question, asked or not.
    answers = {k: v for k, v in answers.items() if v is not None or k in planned or not planned}
    in_order = sorted(answers.items(), key=lambda entry: _order(entry[0], instrument))
    rows = [
        SurveyRow(
            participant=who, lap=lap, condition=laps[who, lap], instrument=instrument.name,
            item=item, **_response(instrument, item, value, file),
        )
        for (who, lap, item), value in in_order
    ]  # fmt: skip
    _write(study, instrument, rows, there)
    silent = sorted(people - there)
    words = [
        *found.unmatched,
        *(f"{who} did not drive lap {lap}" for who, lap in nowhere),
        *(f"{name} is not in the file" for name in silent),
    ]
    answered = sum(value is not None for value in answers.values())
    return ImportedAnswers(len(rows), answered, tuple(words))


def _instrument(study: Study, mapping: AnswersMapping, document: Document) -> Instrument:
    """Return the instrument that was asked; refuse items to reverse that it does not have."""
    by_name = {instrument.name: instrument for instrument in study.instruments}
    instrument = by_name.get(mapping.instrument)
    if instrument is None:
        raise InputError(
            f"{document.source}:{document.line(('instrument',))}: instrument: the study asks no "
            f"{mapping.instrument!r}; {allowed(mapping.instrument, by_name)}"
        )
    ids = instrument.ids(assisted=True)
    for i, name in enumerate(mapping.reversed):
        if name not in ids:
            line = document.line(("reversed", i))
            raise InputError(
                f"{document.source}:{line}: reversed: {name!r} is no item; {allowed(name, ids)}"
            )
    return instrument


def _planned(study: Study, instrument: Instrument) -> set[Key]:
    """Return the questions that the protocol asks after the laps that were driven."""
    laps = study.protocol.laps
    first: dict[str, PlannedLap] = {}
    for planned in laps:
        first.setdefault(planned.condition, planned)
    found: set[Key] = set()
    for row in study.laps.select(["participant", "lap", "condition"]).to_pylist():
        lap, condition = row["lap"], row["condition"]
        # Where participants have orders of their own, a lap is found by its condition.
        in_place = lap < len(laps) and laps[lap].condition == condition
        driven = laps[lap] if in_place else first.get(condition)
        if driven is None:
            continue
        for survey in driven.survey:
            if survey.instrument == instrument.name:
                items = asked_items(study.protocol, driven, survey, instrument)
                found |= {(row["participant"], lap, item) for item in items}
    return found


def _order(key: Key, instrument: Instrument) -> tuple[str, int, int]:
    return key[0], key[1], instrument.ids(assisted=True).index(key[2])


def _response(
    instrument: Instrument, item: str, value: float | str | None, file: Path
) -> dict[str, Any]:
    try:
        return response_fields(instrument.item(item), value, instrument.points)
    except ValueError as error:
        raise InputError(f"{file}: {item}: {error}") from None


def _write(study: Study, instrument: Instrument, rows: list[SurveyRow], people: set[str]) -> None:
    """Write rows of an instrument; those of people who are not in the file only where none are."""
    table = pa.Table.from_pylist([asdict(row) for row in rows], schema=SURVEY_SCHEMA)
    path = study.folder / SURVEYS_TABLE
    if path.exists():
        before = study.surveys.select(SURVEY_SCHEMA.names).cast(SURVEY_SCHEMA)
        ours = pc.equal(before["instrument"], instrument.name)
        in_file = pc.is_in(before["participant"], pa.array(sorted(people), pa.string()))
        kept = before.filter(pc.invert(pc.and_(ours, in_file)))
        answered = kept.filter(pc.equal(kept["instrument"], instrument.name))["participant"]
        new = table.filter(pc.invert(pc.is_in(table["participant"], answered.combine_chunks())))
        table = pa.concat_tables([kept, new])
    order = [("participant", "ascending"), ("lap", "ascending")]
    try:
        write_whole(path, parquet_bytes(table.sort_by(order)))
    except (OSError, pq.lib.ArrowException) as error:
        raise InputError(f"{path}: cannot be written: {error}") from None
