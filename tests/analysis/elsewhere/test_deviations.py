"""What other programs write otherwise: the same statistics, or a word, or a refusal."""

import datetime as dt
import random
import tempfile
import unicodedata
from collections.abc import Callable
from contextlib import suppress
from decimal import Decimal
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from protocols.files.errors import InputError
from protocols.record.check import check_remarks, check_study

Study = Any
"""``conftest.Recorded``."""

Outcome = Literal["same", "changed", "refused"]


class Deviation(NamedTuple):
    """A change of a clean study, and what is to come of it alone.

    Attributes
    ----------
    change
        What is done to the study.
    outcome
        ``same``: every statistic is the clean one's. ``changed``: some are not, and it is said.
        ``refused``: the study is not read.
    says
        Words that are new on the page, or a pattern in the refusal; "" for none.
    """

    change: Callable[[Study, random.Random], None]
    outcome: Outcome
    says: str = ""


def applied(name: str, study: Study, seed: int) -> None:
    """Change a study; a deviation that an earlier one has made impossible changes nothing."""
    with suppress(
        pa.ArrowException, ArithmeticError, AttributeError, LookupError, TypeError, ValueError
    ):
        DEVIATIONS[name].change(study, random.Random(seed))  # noqa: S311 - which row, not a secret


def _set(table: pa.Table, column: str, values: Any) -> pa.Table:
    place = table.schema.get_field_index(column)
    if place < 0:
        return table.append_column(column, values)
    return table.set_column(place, column, values)


def _values(table: str, column: str, change: Callable[[Any], Any], kind: Any = None) -> Any:
    """Return a change of every value of a column."""

    def deviate(study: Study, _: random.Random) -> None:
        given = study.tables[table]
        values = pa.array([change(v) for v in given[column].to_pylist()], kind)
        study.tables[table] = _set(given, column, values)

    return deviate


def _one(table: str, column: str, change: Callable[[Any], Any]) -> Any:
    """Return a change of one value of a column."""

    def deviate(study: Study, rng: random.Random) -> None:
        given = study.tables[table]
        values = given[column].to_pylist()
        row = rng.randrange(len(values))
        values[row] = change(values[row])
        study.tables[table] = _set(given, column, pa.array(values))

    return deviate


def _drop(table: str, column: str) -> Any:
    def deviate(study: Study, _: random.Random) -> None:
        study.tables[table] = study.tables[table].drop_columns([column])

    return deviate


def _steps(column: str, change: Callable[[pa.Table], Any]) -> Any:
    """Return a change of a column of every step table."""

    def deviate(study: Study, _: random.Random) -> None:
        for key, table in study.steps.items():
            study.steps[key] = _set(table, column, change(table))

    return deviate


def _whole(values):
    """Return whole numbers; numbers as they are where some are missing or too large for that."""
    return np.rint(values).astype(np.int64) if (np.abs(values) < 9e18).all() else values


def _times(change: Callable[[np.ndarray], Any]) -> Any:
    return _steps("t_s", lambda table: pa.array(change(table["t_s"].to_numpy())))


def _places(change: Callable[[np.ndarray, np.ndarray], tuple[Any, Any]]) -> Any:
    def deviate(study: Study, _: random.Random) -> None:
        for key, table in study.steps.items():
            x, y = change(table["x_m"].to_numpy(), table["y_m"].to_numpy())
            moved = _set(table, "x_m", pa.array(x))
            study.steps[key] = _set(moved, "y_m", pa.array(y))

    return deviate


def _folders(change: Callable[[str], str]) -> Any:
    def deviate(study: Study, _: random.Random) -> None:
        study.steps = {(change(who), name): t for (who, name), t in study.steps.items()}

    return deviate


def _files(change: Callable[[int], str]) -> Any:
    def deviate(study: Study, _: random.Random) -> None:
        study.steps = {
            (who, change(int(name[6:].partition(".")[0]))): t
            for (who, name), t in study.steps.items()
        }

    return deviate


def _row_again(table: str, change: Callable[[dict[str, Any]], dict[str, Any]]) -> Any:
    def deviate(study: Study, rng: random.Random) -> None:
        given = study.tables[table]
        rows = given.to_pylist()
        rows.insert(rng.randrange(len(rows)), change(dict(rng.choice(rows))))
        study.tables[table] = pa.Table.from_pylist(rows, schema=given.schema)

    return deviate


def _column_again(table: str, column: str, change: Callable[[Any], Any]) -> Any:
    def deviate(study: Study, _: random.Random) -> None:
        given = study.tables[table]
        values = [change(v) for v in given[column].to_pylist()]
        again = pa.array(values, given.schema.field(column).type)
        study.tables[table] = given.append_column(column, again)

    return deviate


def _shuffled(table: str) -> Any:
    def deviate(study: Study, rng: random.Random) -> None:
        order = list(range(len(study.tables[table])))
        rng.shuffle(order)
        study.tables[table] = study.tables[table].take(order)

    return deviate


def _damaged(study: Study, rng: random.Random) -> None:
    who, name = rng.choice(sorted(study.steps))
    study.files[f"sessions/{who}/{name}"] = b"PAR1 is not enough"


def _one_lap_without_steps(study: Study, rng: random.Random) -> None:
    del study.steps[rng.choice(sorted(study.steps))]


def _exchanged(one: tuple[int, int], other: tuple[int, int]) -> Any:
    """Return an exchange of the step tables of two laps, each by participant and lap."""

    def deviate(study: Study, _: random.Random) -> None:
        a, b = ((_people(study)[n], f"steps-{lap}.parquet") for n, lap in (one, other))
        study.steps[a], study.steps[b] = study.steps[b], study.steps[a]

    return deviate


def _all_of_two_people_exchanged(study: Study, rng: random.Random) -> None:
    for lap in range(3):
        _exchanged((0, lap), (2, lap))(study, rng)


def _folders_and_laps_exchanged(study: Study, rng: random.Random) -> None:
    _exchanged((0, 1), (0, 2))(study, rng)
    _all_of_two_people_exchanged(study, rng)


def _cut(study: Study, _: random.Random) -> None:
    key = (_people(study)[0], "steps-1.parquet")
    study.steps[key] = study.steps[key].slice(0, len(study.steps[key]) - 3)


def _rotated(study: Study, _: random.Random) -> None:
    who = _people(study)[0]
    names = [f"steps-{lap}.parquet" for lap in range(3)]
    tables = [study.steps[who, name] for name in names]
    for name, table in zip(names, [*tables[1:], tables[0]], strict=True):
        study.steps[who, name] = table


def _naming(column: str, value: Callable[[str, int], Any], *changes: Any) -> Any:
    """Return step tables that name their lap in a column, then changes."""

    def deviate(study: Study, rng: random.Random) -> None:
        for (who, name), table in study.steps.items():
            said = value(who, int(name[6:].partition(".")[0]))
            study.steps[who, name] = _set(table, column, pa.array([said] * len(table)))
        for change in changes:
            change(study, rng)

    return deviate


def _all_as_long(study: Study, _: random.Random) -> None:
    """Let nothing but a column of their own tell the step tables apart."""
    study.tables["laps"] = study.tables["laps"].drop_columns(["duration_s"])
    for key, table in study.steps.items():
        study.steps[key] = _set(table, "t_s", pa.array(np.zeros(len(table))))


def _one_empty_table(study: Study, rng: random.Random) -> None:
    key = (_people(study)[0], "steps-1.parquet")
    study.steps[key] = study.steps[key].slice(0, 0)


def _helped_where_nobody_may(study: Study, _: random.Random) -> None:
    key = (_people(study)[0], "steps-1.parquet")  # a lap of manual
    table = study.steps[key]
    study.steps[key] = _set(table, "control", pa.array(["demonstrator"] * len(table)))


def _numbered_from_1(study: Study, rng: random.Random) -> None:
    for table in ("laps", "surveys"):
        _values(table, "lap", lambda n: n + 1)(study, rng)
    _files(lambda n: f"steps-{n + 1}.parquet")(study, rng)


def _numbered_from_1_without_practice(study: Study, rng: random.Random) -> None:
    _numbered_from_1(study, rng)
    _drop("laps", "practice")(study, rng)


def _lap_numbers_by_ten(study: Study, rng: random.Random) -> None:
    for table in ("laps", "surveys"):
        _values(table, "lap", lambda n: 10 * (n + 1))(study, rng)
    _files(lambda n: f"steps-{10 * (n + 1)}.parquet")(study, rng)


def _whole_numbers_as_ids(study: Study, _: random.Random) -> None:
    number = {who: n for n, who in enumerate(sorted(set(_people(study))), start=1)}
    for name, table in study.tables.items():
        ids = [number[who] for who in table["participant"].to_pylist()]
        kind = pa.float64() if name == "laps" else pa.int64()
        study.tables[name] = _set(table, "participant", pa.array(ids, kind))
    study.steps = {(str(number[who]), name): t for (who, name), t in study.steps.items()}


def _people(study: Study) -> list[str]:
    return study.tables["participants"]["participant"].to_pylist()


_EPOCH = dt.datetime(2025, 3, 4, 9, 30, tzinfo=dt.UTC)


def _stamps(table: pa.Table, zone: str | None) -> pa.Array:
    start = int(_EPOCH.timestamp() * 1e6)
    whole = [start + round(1e6 * t) for t in table["t_s"].to_pylist()]
    return pa.array(whole, pa.int64()).cast(pa.timestamp("us", zone))


def _nfd(text: str) -> str:
    return unicodedata.normalize("NFD", text)


_LISTS = pa.list_(pa.float64())
_NO_NUMBER = "allowed: double"

DEVIATIONS: dict[str, Deviation] = {
    # What laps say of themselves
    "laps from 1": Deviation(_numbered_from_1, "same", "laps are counted from 1"),
    "laps from 1, no practice": Deviation(
        _numbered_from_1_without_practice, "same", "column practice is missing"),
    "no practice": Deviation(_drop("laps", "practice"), "same", "column practice is missing"),
    "lap numbers 10, 20, 30": Deviation(_lap_numbers_by_ten, "same"),
    "answers from 1": Deviation(
        _values("surveys", "lap", lambda n: n + 1), "same", "laps of answers are counted from 1"),
    "steps from 1": Deviation(
        _files(lambda n: f"steps-{n + 1}.parquet"), "changed", "step tables of laps without a row"),
    "condition in capitals": Deviation(
        _values("laps", "condition", str.upper), "same", "condition 'ASSISTED' is taken for"),
    "condition with blanks": Deviation(
        _values("surveys", "condition", lambda c: f" {c} "), "same", "is taken for 'manual'"),
    "an unknown condition": Deviation(
        _values("laps", "condition", lambda c: {"manual": "by hand"}.get(c, c)), "changed",
        "conditions that the study does not have (by hand)"),
    "a negative lap": Deviation(
        _values("laps", "lap", lambda n: n - 1), "refused", "column lap: -1 in row 0"),
    "half a lap": Deviation(_values("laps", "lap", lambda n: n + 0.5), "refused", "column lap is"),
    "lap as text": Deviation(_values("laps", "lap", str), "same"),
    "lap as true": Deviation(_values("laps", "lap", bool), "refused", "no number"),
    # What step tables say of themselves, against where they are
    "two laps' steps exchanged": Deviation(
        _exchanged((0, 1), (0, 2)), "changed", "fits lap 2, and not lap 1"),
    "three laps' steps exchanged": Deviation(_rotated, "changed", "fits lap 2, and not lap 1"),
    "two people's steps exchanged": Deviation(
        _all_of_two_people_exchanged, "changed", "fits lap 1 of 04, and not lap 1"),
    "one lap of two people exchanged": Deviation(
        _exchanged((0, 1), (2, 1)), "changed", "off the lap's own"),
    "folders and laps exchanged": Deviation(
        _folders_and_laps_exchanged, "changed", "off the lap's own"),
    "three steps cut off": Deviation(_cut, "changed", "off the lap's own"),
    "a person's column": Deviation(_naming("participant", lambda who, _: who), "same"),
    "another person's column": Deviation(
        _naming("participant", lambda who, _: who, _all_as_long, _exchanged((0, 1), (2, 1))),
        "changed", "04 in its column participant"),
    "a device's column": Deviation(_naming("participant", lambda *_: "chair 7"), "same"),
    "a lap's column": Deviation(_naming("lap", lambda _, lap: lap), "same"),
    "a lap's column from 1": Deviation(_naming("lap", lambda _, lap: lap + 1), "same"),
    "another lap's column": Deviation(
        _naming("lap", lambda _, lap: lap, _all_as_long, _exchanged((0, 1), (0, 2))),
        "changed", "2 in its column lap"),
    "another lap's column from 1": Deviation(
        _naming("lap", lambda _, lap: lap + 1, _all_as_long, _exchanged((0, 1), (0, 2))),
        "changed", "2 in its column lap"),
    "another condition's column": Deviation(
        _naming("condition", lambda _, lap: ("assisted", "Manual", "assisted")[lap],
                _all_as_long, _exchanged((0, 1), (0, 2))),
        "changed", "assisted in its column condition"),
    "help where nobody may help": Deviation(
        _helped_where_nobody_may, "same", "commands of the demonstrator count"),
    # What is there, and has nothing in it
    "answers without a row": Deviation(
        lambda s, _: s.tables.update(surveys=s.tables["surveys"].slice(0, 0)), "changed",
        "surveys.parquet: without a row"),
    "no answers": Deviation(
        lambda s, _: s.tables.pop("surveys"), "changed", "surveys.parquet: not there"),
    "steps without a row": Deviation(_one_empty_table, "changed", "the table has no row"),
    "laps without a row": Deviation(
        lambda s, _: s.tables.update(laps=s.tables["laps"].slice(0, 0)), "refused", "has no row"),
    # What is not said
    "no excluded": Deviation(
        _drop("participants", "excluded"), "same", "Who is excluded was not recorded"),
    "no collisions": Deviation(_drop("laps", "collisions"), "same"),
    "no consent": Deviation(_drop("participants", "consented"), "same", "consent unknown: 2"),
    "no duration": Deviation(_drop("laps", "duration_s"), "same"),
    "no lap time": Deviation(_drop("laps", "lap_time_s"), "refused", "lap_time_s is missing"),
    "no participant": Deviation(_drop("laps", "participant"), "refused", "participant is missing"),
    "no condition": Deviation(_drop("surveys", "condition"), "changed", "condition is missing"),
    "no completed": Deviation(_drop("laps", "completed"), "refused", "completed is missing"),
    "one completed missing": Deviation(
        _one("laps", "completed", lambda _: None), "refused", "completed: missing in row"),
    "one condition missing": Deviation(
        _one("laps", "condition", lambda _: None), "refused", "condition: missing in row"),
    "an empty id": Deviation(_one("laps", "participant", lambda _: " "), "refused", "empty in row"),
    # Who it was
    "ids with blanks": Deviation(
        _values("laps", "participant", lambda w: f"{w} "), "same", "taken for one person"),
    "ids decomposed": Deviation(
        _values("surveys", "participant", _nfd), "same", "taken for one person"),
    "folders decomposed": Deviation(_folders(_nfd), "same"),
    "folders with a prefix": Deviation(
        _folders(lambda w: f"sub-{w}"), "changed", "sub-01 (01?)"),
    "folders without zeros": Deviation(
        _folders(lambda w: w.lstrip("0")), "changed", "people who are not in the table"),
    "laps without zeros": Deviation(
        _values("laps", "participant", lambda w: w.lstrip("0")), "changed", "1 (01?)"),
    "a stranger": Deviation(
        _values("laps", "participant", lambda w: {"01": "GHOST"}.get(w, w)), "changed", "(GHOST)"),
    "a slash": Deviation(
        _values("laps", "participant", lambda w: f"x/{w}"), "changed", "people who are not in"),
    "ids as numbers": Deviation(_whole_numbers_as_ids, "same"),
    "nobody is there": Deviation(
        _values("participants", "participant", lambda w: f"p{w}"), "changed", "01 (p01?)"),
    # Types
    "decimal": Deviation(
        _values("laps", "lap_time_s", lambda s: Decimal(str(round(s, 3)))), "same"),
    "times as text": Deviation(_values("laps", "lap_time_s", str), "same"),
    "decimal commas": Deviation(
        _values("laps", "lap_time_s", lambda s: str(s).replace(".", ",")), "refused", _NO_NUMBER),
    "lists": Deviation(
        _values("laps", "lap_time_s", lambda s: [s], _LISTS), "refused", "several values"),
    "structs": Deviation(
        _values("laps", "lap_time_s", lambda s: {"s": s}), "refused", "several values"),
    "times as dates": Deviation(
        _values("laps", "lap_time_s", lambda _: _EPOCH), "refused", _NO_NUMBER),
    "completed as 0 and 1": Deviation(_values("laps", "completed", int), "same"),
    "completed as text": Deviation(_values("laps", "completed", str), "same"),
    "completed as yes": Deviation(
        _values("laps", "completed", lambda _: "yes"), "refused", "column completed is string"),
    "completed as 2": Deviation(
        _values("laps", "completed", lambda _: 2), "refused", "0 or 1"),
    "completed as 0.5": Deviation(
        _values("laps", "completed", lambda _: 0.5), "refused", "0 or 1"),
    "time as true": Deviation(_values("laps", "lap_time_s", bool), "refused", "no number"),
    "small floats": Deviation(
        _values("laps", "lap_time_s", float, pa.float32()), "same"),
    "categories": Deviation(
        lambda s, _: s.tables.update(laps=_set(
            s.tables["laps"], "condition",
            s.tables["laps"]["condition"].combine_chunks().dictionary_encode())), "same"),
    "a nested column of one's own": Deviation(
        lambda s, _: s.tables.update(laps=s.tables["laps"].append_column(
            "log", pa.array([[1.0]] * len(s.tables["laps"]), _LISTS))), "same", "it is left out"),
    "a date of one's own": Deviation(
        lambda s, _: s.tables.update(laps=s.tables["laps"].append_column(
            "when", pa.array([_EPOCH] * len(s.tables["laps"])))), "same"),
    # Ranges
    "no time at all": Deviation(
        _values("laps", "lap_time_s", lambda _: 0.0), "refused", "allowed: above 0"),
    "no lap time anywhere": Deviation(
        _values("laps", "lap_time_s", lambda _: None, pa.float64()), "changed",
        "finished laps without a lap time"),
    "an endless lap": Deviation(
        _one("laps", "lap_time_s", lambda _: float("inf")), "refused", "allowed: above 0"),
    "fewer than no collisions": Deviation(
        _one("laps", "collisions", lambda _: -1), "refused", "allowed: 0 or more"),
    "off the scale": Deviation(
        _one("surveys", "response", lambda _: 9), "changed", "column response: 9"),
    "half an answer": Deviation(
        _one("surveys", "response", lambda r: r // 1 + 0.5), "changed",
        "column response is double"),
    # Rows and columns that are there twice
    "a row again": Deviation(_row_again("laps", lambda row: row), "same", "count once"),
    "a person again": Deviation(_row_again("participants", lambda row: row), "same", "count once"),
    "an answer again": Deviation(_row_again("surveys", lambda row: row), "same", "count once"),
    "a row again, otherwise": Deviation(
        _row_again("laps", lambda row: row | {"lap_time_s": 99.0}), "refused", "2 rows of"),
    "a lap again, with a blank": Deviation(
        _row_again("laps", lambda row: row | {"participant": f"{row['participant']} "}), "same",
        "count once"),
    "a lap again, with a blank, otherwise": Deviation(
        _row_again("laps", lambda row: row | {
            "participant": f"{row['participant']} ", "lap_time_s": 99.0}), "refused", "2 rows of"),
    "a person again, with a blank": Deviation(
        _row_again("participants", lambda row: row | {"participant": f"{row['participant']} "}),
        "changed", "look alike: one person?"),
    "a column again": Deviation(
        _column_again("laps", "lap_time_s", lambda s: s), "same", "2 times with one content"),
    "a column again, otherwise": Deviation(
        _column_again("laps", "lap_time_s", lambda s: s + 1), "refused", "is there 2 times"),
    "rows shuffled": Deviation(_shuffled("laps"), "same"),
    "answers shuffled": Deviation(_shuffled("surveys"), "same"),
    "people shuffled": Deviation(_shuffled("participants"), "same"),
    # Clocks
    "lap times in ms": Deviation(
        _values("laps", "lap_time_s", lambda s: 1000 * s), "refused", "a thousand times"),
    "durations in ms": Deviation(
        _values("laps", "duration_s", lambda s: 1000 * s), "refused", "a thousand times"),
    "t in ms": Deviation(_times(lambda t: 1e3 * t), "same", "t_s is in milliseconds"),
    "t in whole ms": Deviation(
        _times(lambda t: _whole(1e3 * t)), "same", "t_s is in milliseconds"),
    "t in ns": Deviation(_times(lambda t: 1e9 * t), "same", "t_s is in nanoseconds"),
    "t since 1970": Deviation(
        _times(lambda t: t + _EPOCH.timestamp()), "same", "t_s counts from the time of day"),
    "t since 1970 in whole ns": Deviation(
        _times(lambda t: _whole((t + _EPOCH.timestamp()) * 1e9)), "same",
        "t_s is in nanoseconds"),
    "t as date and time in ns": Deviation(
        _steps("t_s", lambda table: _stamps(table, None).cast(pa.timestamp("ns"))), "same",
        "the time of day"),
    "t since 1970 in ms": Deviation(
        _times(lambda t: 1e3 * (t + _EPOCH.timestamp())), "same", "t_s is in milliseconds"),
    "t of the session": Deviation(
        _times(lambda t: t + 77.7), "same", "t_s counts from another moment"),
    "t as date and time": Deviation(
        _steps("t_s", lambda table: _stamps(table, None)), "same", "the time of day"),
    "t in a time zone": Deviation(
        _steps("t_s", lambda table: _stamps(table, "Europe/Berlin")), "same", "the time of day"),
    "t half as fast": Deviation(_times(lambda t: 2 * t), "changed", "does not last as long"),
    "t stands still": Deviation(_times(lambda t: 0 * t), "changed", "does not increase"),
    "t backwards": Deviation(_times(lambda t: t[::-1]), "changed", "does not increase"),
    "t missing": Deviation(_times(lambda t: t * np.nan), "changed", "unrecorded: "),
    # Positions
    "millimetres": Deviation(
        _places(lambda x, y: (1000 * x, 1000 * y)), "changed", "likely: millimetres"),
    "y mirrored": Deviation(_places(lambda x, y: (x, -y)), "changed", "likely: y mirrored"),
    "x and y exchanged": Deviation(
        _places(lambda x, y: (y, x)), "changed", "likely: x and y exchanged"),
    "another origin": Deviation(
        _places(lambda x, y: (x + 30, y - 20)), "changed", "likely: moved by (-30.0, 20.0) m"),
    "latitude": Deviation(
        _places(lambda x, y: (10.1 + x / 7e4, 48.2 + y / 1.1e5)), "changed", "latitude and long"),
    "every second position": Deviation(
        _places(lambda x, y: (np.where(np.arange(len(x)) % 2, x, np.nan), y)), "changed",
        "some steps have no value of x_m"),
    "kilometres": Deviation(
        _places(lambda x, y: (x / 1000, y / 1000)), "changed", "in an obstacle): no map"),
    "positions missing": Deviation(
        _places(lambda x, y: (x * np.nan, y * np.nan)), "changed", "unrecorded: "),
    # Files
    "a damaged step table": Deviation(_damaged, "changed", "not a readable Parquet file"),
    "a lap without steps": Deviation(_one_lap_without_steps, "changed", "without steps: 1"),
    "file names in capitals": Deviation(
        _files(lambda n: f"steps-{n}.PARQUET"), "changed", "step tables of laps without a row"),
    "files of another kind": Deviation(
        _files(lambda n: f"steps-{n}.csv"), "changed", "step tables of laps without a row"),
    "zeros in file names": Deviation(
        _files(lambda n: f"steps-{n:02d}.parquet"), "changed", "step tables of laps without a row"),
}  # fmt: skip


CHANGES = st.lists(
    st.tuples(st.sampled_from(sorted(DEVIATIONS)), st.integers(0, 2**16)), min_size=1, max_size=3
)
ODD = settings(
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)


def nothing_is_silent(recorded, read_study, as_clean, changes):
    """Assert that an odd record is refused in one line, named, or read as the clean one."""
    study = recorded()
    for name, seed in changes:
        applied(name, study, seed)
    with tempfile.TemporaryDirectory() as place:
        folder = study.write(Path(place) / "study")
        refusal, found = None, None
        try:
            found = read_study(folder)
        except InputError as error:
            refusal = str(error)
        if found is None:
            assert "\n" not in refusal
            assert str(folder) in refusal
            assert check_study(folder), "a study that is refused is not whole"
            return
        changed = found.differs(as_clean)
        if changed:
            assert found.words != as_clean.words, f"changed, and nothing said: {changed}"


@settings(ODD, max_examples=500)
@given(changes=CHANGES)
def test_no_traceback_and_no_silent_change(recorded, read_study, as_clean, changes):
    """Five hundred odd records out of a grammar of deviations."""
    nothing_is_silent(recorded, read_study, as_clean, changes)


@pytest.mark.slow
@settings(ODD, max_examples=20_000)
@given(changes=CHANGES)
def test_no_traceback_and_no_silent_change_long(recorded, read_study, as_clean, changes):
    """The long form: twenty thousand."""
    nothing_is_silent(recorded, read_study, as_clean, changes)


@pytest.mark.parametrize("name", sorted(DEVIATIONS))
def test_a_deviation_alone(recorded, read_study, as_clean, tmp_path, name):
    """Each by itself: refused with its own words, or with the statistics it should have."""
    study = recorded()
    applied(name, study, 1)
    folder = study.write(tmp_path / "study")
    outcome = DEVIATIONS[name].outcome
    if outcome == "refused":
        with pytest.raises(InputError, match=DEVIATIONS[name].says):
            read_study(folder)
        return
    found = read_study(folder)
    faults = check_study(folder)
    new = "; ".join(sorted(found.words - as_clean.words))
    if outcome == "same":
        assert found.differs(as_clean) == []
    else:
        assert found.differs(as_clean)
        assert new
        assert faults or check_remarks(folder), "check names what the page names"
    assert DEVIATIONS[name].says in new
