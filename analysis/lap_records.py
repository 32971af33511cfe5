"""One pass over the steps of every analysed lap: its measures, and what maps and models need."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from analysis.frames import StudyFrames, within
from analysis.measures.registry import MEASURES
from analysis.measures.streams import Steps, gaps, helped, recorded, stream
from analysis.processes import HERE, Processes
from protocols.files.errors import InputError
from protocols.record.elsewhere.placement import Placement, said_of
from protocols.record.reader import Study
from protocols.record.steps import STEP_COLUMNS

POOLED = ("x_m", "y_m", "h_would", "p_help")
"""Numeric step columns that are kept of every lap."""

WORDS = ("section", "section_kind")
"""Step columns of words that are kept, too."""

PIECE = 20
"""Laps that are read at a time."""


_FIRST_COLUMNS = tuple(column.name for column in STEP_COLUMNS if column.since == 1)
"""What came later is missing in older records and in simulated time, and no measure needs it."""


@dataclass(frozen=True, slots=True)
class LapRecords:
    """What follows from the steps of the analysed laps.

    Attributes
    ----------
    measures
        One row per lap: participant, lap, condition, completed and every measure.
    steps
        One row per step: participant, condition, position, whether assistance counted (``helped``,
        0, 1 or NaN), h_would, p_help, section and its kind.
    without_steps
        Analysed laps whose steps were not recorded: no step table, an empty one, or a damaged one.
    unrecorded
        Step columns without a value in any analysed lap.
    gaps
        What cannot be used of steps that were recorded, in words, and in how many laps.
    damaged
        Step tables that cannot be read, and why, in words; their laps count as without steps.
    misplaced
        Laps whose positions are not on the course, and what they may be, in words; no map is drawn
        from them.
    """

    measures: pd.DataFrame
    steps: pd.DataFrame
    without_steps: int
    unrecorded: tuple[str, ...] = ()
    gaps: Mapping[str, int] = field(default_factory=dict)
    damaged: tuple[str, ...] = ()
    misplaced: tuple[str, ...] = ()


def read_laps(
    frames: StudyFrames,
    progress: Callable[[str], None] | None = None,
    others: Processes = HERE,
) -> LapRecords:
    """Read the steps of every analysed lap once.

    A step table that cannot be read is named, and its lap kept as one without steps: the other
    laps can still be analysed.

    Parameters
    ----------
    frames
        The study's tables.
    progress
        Told in a few words what is being done.
    others
        Processes that read them.
    """
    found: Counter[str] = Counter()
    unrecorded = list(_FIRST_COLUMNS)
    laps: list[_Lap] = []
    for piece in _pieces(frames, progress or (lambda _: None), others):
        laps += piece.laps
        unrecorded = [name for name in unrecorded if name in piece.unrecorded]
    for lap in laps:
        found.update(lap.gaps)
    pooled = [lap.kept for lap in laps if lap.kept is not None]
    names = [m.name for m in MEASURES]
    columns = ["participant", "lap", "condition", "completed", *names]
    measures = pd.DataFrame([lap.row for lap in laps], columns=columns).astype(
        {**dict.fromkeys(names, "float64"), "completed": "bool"}
    )
    return LapRecords(
        measures=measures,
        steps=_together(pooled),
        without_steps=len(frames.laps) - len(pooled),
        unrecorded=tuple(unrecorded) if pooled else (),
        gaps=dict(sorted(found.items())),
        damaged=tuple(lap.damaged for lap in laps if lap.damaged is not None),
        misplaced=tuple(said_of([lap.elsewhere for lap in laps if lap.elsewhere is not None])),
    )


@dataclass(frozen=True, slots=True)
class _Kept:
    """What is kept of a lap's steps: numbers by name, and words by name as codes."""

    participant: str
    lap: int
    condition: str
    numbers: dict[str, NDArray[np.float32]]
    words: dict[str, pa.DictionaryArray]


@dataclass(frozen=True, slots=True)
class _Lap:
    """What the steps of one lap say; ``kept`` is None without steps."""

    row: dict[str, Any]
    kept: _Kept | None = None
    gaps: tuple[str, ...] = ()
    elsewhere: Placement | None = None
    damaged: str | None = None


@dataclass(frozen=True, slots=True)
class _Piece:
    """Some laps, and the columns without a value in any of them."""

    laps: list[_Lap]
    unrecorded: list[str]


_Where = tuple[str, int, str, bool]
"""Participant, lap, condition, and whether it was completed."""


def _pieces(
    frames: StudyFrames, tell: Callable[[str], None], others: Processes
) -> Iterator[_Piece]:
    """Yield the analysed laps in their order; many laps are read by several processes."""
    laps = frames.laps
    places: list[_Where] = list(
        zip(
            laps["participant"].tolist(),
            laps["lap"].tolist(),
            laps["condition"].tolist(),
            laps["completed"].astype(bool).tolist(),
            strict=True,
        )
    )
    pieces = [places[i : i + PIECE] for i in range(0, len(places), PIECE)]
    done = 0
    tell(f"Measuring laps: 0 of {len(places)}")
    for piece in others.in_order(partial(_read, frames.study), pieces):
        done += len(piece.laps)
        tell(f"Measuring laps: {done} of {len(places)}")
        yield piece


def _read(study: Study, places: Sequence[_Where]) -> _Piece:
    unrecorded = list(_FIRST_COLUMNS)
    laps = []
    for participant, lap, condition, completed in places:
        where = {"participant": participant, "lap": lap, "condition": condition}
        row = {**where, "completed": completed}
        try:
            steps, remarks, placement = _steps(study, participant, lap)
        except InputError as error:
            laps.append(_Lap(row, damaged=within(study, error)))
            continue
        if not len(steps):
            laps.append(_Lap(row, gaps=remarks))
            continue
        unrecorded = [name for name in unrecorded if not recorded(steps, name)]
        row |= {m.name: m.of(steps) for m in MEASURES}
        kept = _kept(steps, participant, lap, condition, placement)
        elsewhere = None if placement.on_course else placement
        laps.append(_Lap(row, kept, tuple(dict.fromkeys((*remarks, *gaps(steps)))), elsewhere))
    return _Piece(laps, unrecorded)


def _steps(study: Study, participant: str, lap: int) -> tuple[Steps, tuple[str, ...], Placement]:
    """Return a lap's steps and what was found about them; no step without a record.

    Distances between positions that are not in metres are no distances: those are left out.
    """
    if not study.has_steps(participant, lap):
        return Steps(pa.table({})), (), Placement(on_course=True)
    table, remarks, placement = study.lap_steps(participant, lap)
    if not (placement.on_course or placement.metres):
        table = table.drop_columns(["x_m", "y_m"])
    return Steps(table), remarks, placement


def _kept(steps: Steps, participant: str, lap: int, condition: str, placement: Placement) -> _Kept:
    on = helped(steps)
    numbers = {name: stream(steps, name).astype(np.float32) for name in POOLED}
    unknown = np.full(len(steps), np.nan, dtype=np.float32)
    if not placement.on_course:
        numbers |= {"x_m": unknown, "y_m": unknown}
    numbers["helped"] = (unknown if on is None else on).astype(np.float32)
    words = {name: steps.columns[name].combine_chunks().dictionary_encode() for name in WORDS}
    return _Kept(participant, lap, condition, numbers, words)


def _together(pooled: Sequence[_Kept]) -> pd.DataFrame:
    if not pooled:
        names = ["participant", "condition", *WORDS, "lap", *POOLED, "helped"]
        return pd.DataFrame({name: pd.Series(dtype="float64") for name in names})
    lengths = [len(kept.numbers["helped"]) for kept in pooled]
    joined = {
        name: np.concatenate([kept.numbers[name] for kept in pooled])
        for name in (*POOLED, "helped")
    }
    return pd.DataFrame(
        {
            "participant": _repeated([kept.participant for kept in pooled], lengths),
            "lap": np.repeat(np.array([kept.lap for kept in pooled], dtype=np.int16), lengths),
            "condition": _repeated([kept.condition for kept in pooled], lengths),
            **joined,
            **{name: _joined([kept.words[name] for kept in pooled]) for name in WORDS},
        }
    )


def _repeated(words: Sequence[str], lengths: Sequence[int]) -> "pd.Categorical[str]":
    """Return a word for each lap as one for each of its steps."""
    known = sorted(set(words))
    place = {word: i for i, word in enumerate(known)}
    codes = [place[word] for word in words]
    return pd.Categorical.from_codes(np.repeat(codes, lengths), pd.Index(known))


def _joined(words: Sequence[pa.DictionaryArray]) -> pd.Categorical:
    """Return the words of all laps, their kinds sorted."""
    one = pa.chunked_array(words).unify_dictionaries().combine_chunks()
    found = pd.Categorical.from_codes(
        pc.fill_null(one.indices, -1).to_numpy(), one.dictionary.to_pylist()
    )
    return found.reorder_categories(sorted(found.categories))
