"""What is wrong in a study that other programs recorded: its tables and how they join."""

from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from protocols.files.errors import InputError
from protocols.laps import WHOLE_SESSION
from protocols.record.elsewhere.joined import unlike_completed
from protocols.record.elsewhere.people import strangers
from protocols.record.elsewhere.placement import said_of
from protocols.record.merge import LAPS_TABLE, SURVEYS_TABLE
from protocols.record.reader import Study, off_scale, open_study

Tell = Callable[[str], None]
"""Called with what is being looked at now."""


def foreign_faults(folder: Path, tell: Tell | None = None) -> Iterator[str]:
    """Read everything there is of a study that was recorded elsewhere, and name what is wrong.

    Its tables have no checksums; their values are compared with one another, the plan, the course
    and the folders there are.
    """
    try:
        study = open_study(folder)
    except InputError as error:
        yield str(error)
        return
    yield from _strangers(study, study.laps, LAPS_TABLE)
    yield from _answers(study)
    yield from (f"{folder}: {what}" for what in study.strays)
    yield from _steps(study, tell)


def _answers(study: Study) -> Iterator[str]:
    try:
        answers = study.surveys
    except InputError as error:
        yield str(error)
        return
    yield from _strangers(study, answers, SURVEYS_TABLE)
    path = study.folder / SURVEYS_TABLE
    known = {instrument.name for instrument in study.instruments}
    yield from _unknown(answers, "instrument", known, path)
    for instrument in study.instruments:
        own = answers.filter(pc.equal(answers["instrument"], instrument.name))
        items = set(instrument.ids(assisted=True))
        yield from _unknown(own, "item", items, path)
    for _, fault in off_scale(study):
        yield fault


def _strangers(study: Study, rows: pa.Table, name: str) -> Iterator[str]:
    path = study.folder / name
    n, names = strangers(
        rows["participant"].to_pylist(), study.participants["participant"].to_pylist()
    )
    if n:
        yield f"{path}: {n} rows of people who are not in participants.parquet ({names})"
    known = set(study.protocol.conditions)
    if name == SURVEYS_TABLE:
        known.add(WHOLE_SESSION)
    yield from _unknown(rows, "condition", known, path)


def _unknown(rows: pa.Table, column: str, known: set[str], path: Path) -> Iterator[str]:
    count = Counter(name for name in rows[column].to_pylist() if name not in known)
    if count:
        names = ", ".join(repr(name) for name in sorted(count)[:5])
        allowed = ", ".join(sorted(known)) or "nothing"
        yield f"{path}: {count.total()} rows of {column} {names}; allowed: {allowed}"


def without_steps(study: Study) -> Iterator[str]:
    """Name the laps that have no step table, where others have one, in words."""
    laps = list(zip(*(study.laps[c].to_pylist() for c in ("participant", "lap")), strict=True))
    absent = [f"{who}: {lap}" for who, lap in laps if not study.has_steps(who, lap)]
    if absent and len(absent) < len(laps):
        names = ", ".join(absent[:3]) + (", ..." if len(absent) > 3 else "")
        yield f"{len(absent)} of {len(laps)} laps have no step table ({names})"


def times_unlike_completed(study: Study) -> Iterator[str]:
    """Name the laps of which lap time and ``completed`` do not go together, in words."""
    times = study.laps["lap_time_s"].cast(pa.float64()).to_numpy()
    completed = np.array(study.laps["completed"].to_pylist(), dtype=bool)
    yield from unlike_completed(completed, ~np.isnan(times))


def _steps(study: Study, tell: Tell | None) -> Iterator[str]:
    """Read every step table, and name what keeps it from being used as it is."""
    said: Counter[str] = Counter()
    misplaced = []
    laps = list(zip(*(study.laps[c].to_pylist() for c in ("participant", "lap")), strict=True))
    for number, (who, lap) in enumerate(laps, start=1):
        if tell is not None and number % 20 == 1:
            tell(f"Lap {number} of {len(laps)}")
        if not study.has_steps(who, lap):
            continue
        try:
            steps = study.lap_steps(who, lap)
        except InputError as error:
            yield str(error)
            continue
        said.update(steps.remarks)
        if not steps.placement.on_course:
            misplaced.append(steps.placement)
    for remark, n in sorted(said.items()):
        yield f"{study.folder}: in the steps of {n} laps, {remark}"
    for remark in said_of(misplaced):
        yield f"{study.folder}: {remark}"
