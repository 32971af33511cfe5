"""Logs of a study directory: not part of the record."""

import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from protocols.files.csv_text import csv_text
from protocols.record.atomic import naming, write_whole

LOGS = "logs"


def write_log(folder: Path, name: str, text: str) -> None:
    """Write a log file of a study directory."""
    path = folder / LOGS / name
    path.parent.mkdir(exist_ok=True)
    write_whole(path, text.encode())


def write_failure(folder: Path, participant: str, trace: str) -> None:
    """Keep the traceback of a session that raised."""
    write_log(folder, _name("failed", participant), trace)


def write_given_up(folder: Path, participant: str, reason: str) -> None:
    """Keep why a session was given up after its processes died: the next run tries it again."""
    write_log(folder, _name("died", participant), f"{reason}\n")


def clear_failure(folder: Path, participant: str) -> None:
    """Forget an earlier failure of a session that is run again, or has now succeeded."""
    for how in ("failed", "died"):
        (folder / LOGS / _name(how, participant)).unlink(missing_ok=True)


def failures(folder: Path) -> tuple[str, ...]:
    """Return the participants whose last session raised, or was given up, sorted."""
    return tuple(sorted({*raised(folder), *_participants(folder, "died")}))


def raised(folder: Path) -> tuple[str, ...]:
    """Return the participants whose last session raised: it would raise again."""
    return tuple(sorted(_participants(folder, "failed")))


def failure_reason(folder: Path, participant: str) -> str:
    """Return in one line what ended a failed session; "" when nothing is known."""
    for how in ("failed", "died"):
        with suppress(OSError):
            return _last_error((folder / LOGS / _name(how, participant)).read_text())
    return ""


def _last_error(trace: str) -> str:
    """Return the first line of the message a traceback ends with: it follows the code's lines."""
    lines = trace.strip().splitlines()
    code = [i for i, line in enumerate(lines) if line.startswith("  ")]
    after = lines[code[-1] + 1 :] if code else lines[-1:]
    return (after or lines or [""])[0]


def _participants(folder: Path, how: str) -> Iterator[str]:
    names = (path.stem for path in (folder / LOGS).glob(_name(how, "*")))
    return (name.removeprefix(f"{how}-") for name in names)


def _name(how: str, participant: str) -> str:
    return f"{how}-{participant}.txt"


def write_timing(folder: Path, participant: str, wall_s: float) -> None:
    """Add how long a session took, in s, to ``logs/timing.csv``."""
    _append(folder, "timing.csv", (participant, f"{wall_s:.3f}"), ("participant", "wall_s"))


def write_death(folder: Path, participant: str, reason: str) -> None:
    """Add to ``logs/deaths.csv`` that a process died during a session, which is run again."""
    _append(folder, "deaths.csv", (participant, reason), ("participant", "reason"))


def write_warnings(folder: Path, participant: str, warned: Sequence[str]) -> None:
    """Keep Python's warnings of a session; writes nothing when there were none."""
    if warned:
        write_log(folder, f"warnings-{participant}.txt", "\n".join(warned) + "\n")


def _append(folder: Path, name: str, row: Sequence[str], header: Sequence[str]) -> None:
    path = folder / LOGS / name
    path.parent.mkdir(exist_ok=True)
    text = csv_text([row])
    with naming(path), path.open("a+b") as stream:
        if stream.seek(0, os.SEEK_END) == 0:
            text = csv_text([header, row])
        elif _is_cut_short(stream):
            text = f"\n{text}"
        stream.write(text.encode())


def _is_cut_short(opened: BinaryIO) -> bool:
    """Return whether a run was killed in the middle of the last line."""
    opened.seek(-1, os.SEEK_END)
    return opened.read() != b"\n"
