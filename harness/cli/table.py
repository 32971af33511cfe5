"""The table a person wants to see when a study has been run."""

from pathlib import Path


def print_lap_times(folder: Path) -> None: ...
