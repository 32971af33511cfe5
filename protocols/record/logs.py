"""Logs of a study directory: not part of the record."""

from pathlib import Path

from protocols.record.atomic import write_whole

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


def write_timing(folder: Path, participant: str, wall_s: float) -> None:
    """Add how long a session took, in s, to ``logs/timing.csv``."""
    path = folder / LOGS / "timing.csv"
    path.parent.mkdir(exist_ok=True)
    header = "" if path.exists() else "participant,wall_s\n"
    with path.open("a", encoding="utf-8") as stream:
        stream.write(f"{header}{participant},{wall_s:.3f}\n")
