"""What could tell who took part, and what becomes of it before a study is handed on."""

import re
from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType

import pyarrow as pa
import pyarrow.compute as pc

from protocols.files.errors import InputError
from protocols.files.suggestion import allowed
from protocols.record.column import Column
from protocols.record.rows import participant_id

INCLUDES = MappingProxyType(
    {
        "ages": "exact ages in years; without it, bands of ten years, 90 and above as one",
        "words": "people's own words: reasons for leaving or stopping, answers that are text, and "
        "what other programs wrote where the study has no such word",
        "ids": "ids that other programs gave and that are no short codes such as P01 or 7: a name, "
        "an address or a platform's id; without it, they become P0001, P0002, ...",
    }
)
"""What ``--include`` can add, and what it means."""

BAND_YEARS = 10
OLDEST_YEARS = 90
"""From here on one band: so old a person is often the only one (as the HIPAA safe harbour has it:
all ages above 89 are one category)."""

_WORDS = frozenset({"withdrawal", "stop_reason", "response_text"})

_CODE = re.compile(r"[A-Za-z]{0,11}[-_ ]?\d{1,5}")
"""An id that only the people of the study can read: letters, then a short number."""

AGE = Column("age_years", pa.int16(), "Age", "years", nullable=True)
AGE_BAND = Column(
    "age_band", pa.string(), "Age in years, in bands of ten such as 20-29; 90+ from 90 on",
    nullable=True,
)  # fmt: skip


def check_includes(include: Collection[str]) -> None:
    """Refuse something to include that there is not.

    Raises
    ------
    InputError
        Lists what can be included.
    """
    for name in include:
        if name not in INCLUDES:
            raise InputError(f"--include: {name!r} is not known; {allowed(name, INCLUDES)}")


def minimised(
    table: pa.Table, columns: tuple[Column, ...], include: Collection[str]
) -> tuple[pa.Table, tuple[Column, ...]]:
    """Return a table and its columns without what could tell who took part.

    Parameters
    ----------
    table
        Has every one of ``columns``.
    columns
        Of the record; columns that other programs added are left out.
    include
        Names in ``INCLUDES``: what is kept all the same.
    """
    kept: list[Column] = []
    arrays = []
    for column in columns:
        if column.name in _WORDS and "words" not in include:
            continue
        if column.name == AGE.name and "ages" not in include:
            kept.append(AGE_BAND)
            arrays.append(age_bands(table[AGE.name]))
            continue
        kept.append(column)
        arrays.append(table[column.name])
    return pa.table(dict(zip([c.name for c in kept], arrays, strict=True))), tuple(kept)


def exported_ids(ids: Sequence[str]) -> dict[str, str]:
    """Return the ids under which people are exported: their own where all are codes.

    Examples
    --------
    >>> exported_ids(["P01", "P02"])
    {'P01': 'P01', 'P02': 'P02'}
    >>> exported_ids(["jo@example.org", "7"])
    {'jo@example.org': 'P0001', '7': 'P0002'}
    """
    if all(_CODE.fullmatch(name) for name in ids):
        return {name: name for name in ids}
    return {name: participant_id(number) for number, name in enumerate(ids, start=1)}


def only_known(table: pa.Table, known: Mapping[str, Collection[str]]) -> pa.Table:
    """Return a table in which columns of words hold words of the study, and nothing else.

    Parameters
    ----------
    table
        As another program recorded it: there may be anything in it.
    known
        The words of some of its columns; what is not among them becomes missing.
    """
    for name, words in known.items():
        at = table.schema.get_field_index(name)
        if at < 0:
            continue
        given = table[name]
        kept = pc.if_else(pc.is_in(given, pa.array(sorted(words), pa.string())), given, None)
        table = table.set_column(at, name, kept)
    return table


def age_bands(ages: pa.ChunkedArray) -> pa.ChunkedArray:
    """Return ages as bands of ten years.

    Examples
    --------
    >>> age_bands(pa.chunked_array([[27, 95, None]])).to_pylist()
    ['20-29', '90+', None]
    """
    bands = [None if age is None else _band(int(age)) for age in ages.to_pylist()]
    return pa.chunked_array([pa.array(bands, pa.string())])


def _band(age: int) -> str:
    lowest = age // BAND_YEARS * BAND_YEARS
    return f"{OLDEST_YEARS}+" if age >= OLDEST_YEARS else f"{lowest}-{lowest + BAND_YEARS - 1}"


def unique_people(participants: pa.Table) -> int:
    """Return how many people nobody else equals in age, gender and handedness as exported."""
    traits = [
        name
        for name in ("age_years", "age_band", "gender", "handedness")
        if name in participants.column_names
    ]
    if not traits or not len(participants):
        return 0
    counted = participants.group_by(traits).aggregate([([], "count_all")])
    return int(pc.sum(pc.equal(counted["count_all"], 1)).as_py() or 0)
