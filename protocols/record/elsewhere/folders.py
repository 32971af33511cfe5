"""Session folders and step tables that belong to no participant or to no lap."""

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from protocols.record.atomic import is_partial
from protocols.record.elsewhere.people import named, one_form
from protocols.record.session import LAPS_FILE, PARTICIPANT_FILE, SURVEYS_FILE, steps_file

_OTHER_TABLES = {PARTICIPANT_FILE, LAPS_FILE, SURVEYS_FILE}


def folders_by_person(folders: Iterable[Path], people: Iterable[str]) -> dict[str, Path]:
    """Return each participant's session folder: the one of that name, else the only one like it.

    File systems write letters with marks as one character or as two; a person sees no difference.
    """
    by_name = {path.name: path for path in folders}
    alike: dict[str, list[Path]] = {}
    for name, path in by_name.items():
        alike.setdefault(one_form(name), []).append(path)
    found = {}
    for who in people:
        same = alike.get(one_form(who), [])
        if who in by_name:
            found[who] = by_name[who]
        elif len(same) == 1:
            found[who] = same[0]
    return found


def lap_shift(numbers: Mapping[Path, Iterable[int]]) -> int:
    """Return what to subtract from a lap's number for its step table's: 1 where these count from 0.

    Parameters
    ----------
    numbers
        Numbers of the laps of each session folder's participant.

    Returns
    -------
    int
        1 when in every folder each lap has a step table of the number before it, and not all have
        one of their own number; else 0.
    """
    shifted = False
    for folder, laps in numbers.items():
        there, wanted = set(step_numbers(folder)), set(laps)
        if there and there != {n - 1 for n in wanted}:
            return 0
        shifted = shifted or bool(there)
    return int(shifted)


def step_numbers(folder: Path) -> Iterator[int]:
    """Yield the numbers of the step tables of a session folder."""
    for path in folder.glob(steps_file("*")):
        number = path.stem.rpartition("-")[2]
        if number.isdigit() and steps_file(number) == steps_file(int(number)):
            yield int(number)


def strays(
    sessions: Path, owners: Mapping[Path, tuple[str, set[int]]], people: Iterable[str]
) -> Iterator[str]:
    """Name the step tables that no lap refers to, in words.

    Parameters
    ----------
    sessions
        The folder of session folders.
    owners
        By session folder, its participant and the numbers that step tables may have there.
    people
        Everyone in the table of participants.
    """
    if not sessions.is_dir():
        return
    loose = sorted(path.name for path in sessions.iterdir() if _is_table(path))
    if loose:
        yield f"{_number(len(loose), 'table')} beside the session folders ({_some(loose)})"
    folders = sorted(path for path in sessions.iterdir() if path.is_dir())
    others = {p.name: _tables(p) for p in folders if p not in owners and not is_partial(p)}
    unknown = {name: tables for name, tables in others.items() if tables}
    tables = sum(len(names) for names in unknown.values())
    if unknown:
        yield (
            f"{_number(tables, 'step table')} in {_number(len(unknown), 'session folder')} of "
            f"people who are not in the table of participants ({named(unknown, people)})"
        )
    without = [
        f"{who}: {name}"
        for path, (who, laps) in sorted(owners.items())
        for name in _tables(path)
        if name not in {steps_file(lap) for lap in laps}
    ]
    if without:
        yield f"{_number(len(without), 'step table')} of laps without a row ({_some(without)})"


def _tables(folder: Path) -> list[str]:
    names = (path.name for path in folder.iterdir() if _is_table(path))
    return sorted(name for name in names if name not in _OTHER_TABLES)


def _is_table(path: Path) -> bool:
    """Return whether a file is a table, or was meant to be one of steps: steps-0.csv."""
    name = path.name.lower()
    return name.endswith(".parquet") or (name.startswith("steps") and path.is_file())


def unusable_names(people: Iterable[str]) -> list[str]:
    """Return the ids that no folder can be called: their steps cannot be there."""
    return sorted(who for who in people if re.search(r"[/\\\0]", who) or who in {".", ".."})


def _some(names: list[str]) -> str:
    return ", ".join(names[:3]) + (", ..." if len(names) > 3 else "")


def _number(n: int, one: str) -> str:
    return f"{n} {one}" if n == 1 else f"{n} {one}s"
