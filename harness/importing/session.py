"""One recording as a session: who drove which laps, and where they begin."""

import re
from dataclasses import dataclass, replace
from itertools import accumulate
from pathlib import Path

from harness.importing.cutting import Cutting
from harness.importing.mapping import BagMapping, Person
from harness.importing.recording import Stream, read_streams
from harness.importing.signals import texts, topics
from harness.session.model import saved
from protocols.exclusion import exclusion_reason
from protocols.files.errors import InputError
from protocols.files.suggestion import allowed
from protocols.laps import PlannedLap
from protocols.order import in_words
from protocols.record.rows import ParticipantRow
from protocols.record.session import RecordedLap, SessionRecord
from protocols.resolved import ResolvedStudy
from protocols.study import StudyProtocol


@dataclass(frozen=True)
class ImportedSession:
    """A session, and what is to be known about its recording, in words."""

    record: SessionRecord
    troubles: tuple[str, ...]


def read_session(
    path: Path, mapping: BagMapping, person: Person, study: ResolvedStudy
) -> ImportedSession:
    """Return the session that a recording holds.

    Parameters
    ----------
    path
        The recording.
    mapping
        What is what in it.
    person
        Who sat in the chair.
    study
        What was driven.

    Raises
    ------
    InputError
        When a topic is missing or of another type, the recording is damaged, its clocks or frames
        do not fit, or no lap begins in it.
    """
    streams = read_streams(path, topics(mapping), mapping.clock)
    cutting = Cutting(path, mapping, study, streams)
    starts = _starts(path, mapping, streams[mapping.starts.topic])
    planned = laps_driven(study.protocol, person, path)
    if len(starts) > len(planned):
        cutting.troubles.append(
            f"{path}: {len(starts)} laps begin; the protocol plans {len(planned)}: the rest is left"
        )
    ends = [*starts[1:], int(cutting.ns[-1]) + 1]
    laps = [
        cutting.lap(i, lap, person, begin, end)
        for i, (lap, begin, end) in enumerate(zip(planned, starts, ends, strict=False))
    ]
    laps = _placed(laps)
    rows = [lap.row for lap in laps]
    reason = exclusion_reason(study.protocol.exclusion, rows)
    row = ParticipantRow(
        participant=person.participant,
        kind=person.kind,
        driver="recorded",
        age_years=person.age_years,
        gender=person.gender,
        handedness=person.handedness,
        traits={},
        consented=person.consented,
        completed=len(rows) == len(study.protocol.laps) and all(lap.completed for lap in rows),
        laps_planned=len(study.protocol.laps),
        laps_driven=len(rows),
        excluded=reason is not None,
        exclusion_reason=reason,
        order=in_words(planned),
    )
    model = saved(cutting.model) if any(lap.training for lap in rows) else None
    return ImportedSession(SessionRecord(row, tuple(laps), (), model), tuple(cutting.troubles))


def laps_driven(protocol: StudyProtocol, person: Person, path: Path) -> tuple[PlannedLap, ...]:
    """Return the laps that a person drove, as the protocol plans them, in the person's order.

    Raises
    ------
    InputError
        When the protocol has no lap of a condition left, or has an order for each participant and
        the mapping does not say which.
    """
    if person.laps is None:
        if protocol.orders.use != "fixed":
            raise InputError(
                f"{path}: {person.participant}: 'laps' is missing; the protocol has an order for "
                "each participant: list the conditions in the order in which they were driven"
            )
        return protocol.laps
    left = list(protocol.laps)
    driven = []
    for condition in person.laps:
        lap = next((lap for lap in left if lap.condition == condition), None)
        if lap is None:
            names = list(dict.fromkeys(lap.condition for lap in left))
            raise InputError(
                f"{path}: {person.participant}: laps: the protocol has no lap of {condition!r} "
                f"left; {allowed(condition, names)}"
            )
        left.remove(lap)
        driven.append(lap)
    return tuple(driven)


def _starts(path: Path, mapping: BagMapping, stream: Stream) -> list[int]:
    """Return when laps begin, ns."""
    pattern = mapping.starts.text
    marks = [
        ns
        for ns, text in zip(stream.ns.tolist(), texts(stream), strict=True)
        if pattern is None or (isinstance(text, str) and re.search(pattern, text))
    ]
    if not marks:
        raise InputError(
            f"{path}: no message of {stream.topic} has {pattern!r} in it; no lap begins"
        )
    return marks


def _placed(laps: list[RecordedLap]) -> list[RecordedLap]:
    """Return the laps with their place among the analysed ones, from 1."""
    places = accumulate(int(not lap.row.practice) for lap in laps)
    return [
        lap if lap.row.practice else replace(lap, row=replace(lap.row, place=place))
        for lap, place in zip(laps, places, strict=True)
    ]
