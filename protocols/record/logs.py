"""Logs of a study directory: not part of the record."""

from collections.abc import Sequence
from pathlib import Path

from protocols.record.atomic import naming, write_whole

LOGS = "logs"


def write_log(folder: Path, name: str, text: str) -> None:
    """Write a log file of a study directory."""
    path = folder / LOGS / name
    path.parent.mkdir(exist_ok=True)
    write_whole(path, text.encode())


def write_failure(folder: Path, participant: str, trace: str) -> None:
    """Keep the traceback of a session that raised."""
    write_log(folder, _failure_name(participant), trace)


def clear_failure(folder: Path, participant: str) -> None:
    """Forget an earlier failure of a session that has now succeeded."""
    (folder / LOGS / _failure_name(participant)).unlink(missing_ok=True)


def failures(folder: Path) -> tuple[str, ...]:
    """Return the participants whose last session raised, sorted."""
    names = (path.stem for path in (folder / LOGS).glob("failed-*.txt"))
    return tuple(sorted(name.removeprefix("failed-") for name in names))


def _failure_name(participant: str) -> str:
    return f"failed-{participant}.txt"


def failure_reason(folder: Path, participant: str) -> str:
    """Return the last line of a failed session's traceback; "" when there is none."""
    try:
        lines = (folder / LOGS / _failure_name(participant)).read_text().strip().splitlines()
    except OSError:
        return ""
    return lines[-1] if lines else ""


def write_timing(folder: Path, participant: str, wall_s: float) -> None:
    """Add how long a session took, in s, to ``logs/timing.csv``."""
    _append(folder, "timing.csv", f"{participant},{wall_s:.3f}", header="participant,wall_s")


def write_death(folder: Path, participant: str, reason: str) -> None:
    """Add to ``logs/deaths.csv`` that a process died during a session, which is run again."""
    _append(folder, "deaths.csv", f"{participant},{reason}", header="participant,reason")


def write_warnings(folder: Path, participant: str, warned: Sequence[str]) -> None:
    """Keep what Python warned of during a session; writes nothing when there was nothing."""
    if warned:
        write_log(folder, f"warnings-{participant}.txt", "\n".join(warned) + "\n")


def _append(folder: Path, name: str, line: str, header: str) -> None:
    path = folder / LOGS / name
    path.parent.mkdir(exist_ok=True)
    first = "" if path.exists() else f"{header}\n"
    with naming(path), path.open("a", encoding="utf-8") as stream:
        stream.write(f"{first}{line}\n")
