"""Exports of a made-up study, and the checkers that other people wrote."""

import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pandas as pd
import pytest
from packaging.version import Version

from analysis.export.write import export_study
from protocols.load import resolve_study
from protocols.record.reader import Study
from protocols.shipped import shipped_text


@pytest.fixture(scope="session")
def exported(study: Study, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return the function that exports the made-up study in a format, once; not to be touched."""
    made: dict[str, Path] = {}

    def export(name: str) -> Path:
        if name not in made:
            made[name] = tmp_path_factory.mktemp("exports") / name
            export_study(study.folder, name, made[name])
        return made[name]

    return export


@pytest.fixture(scope="session")
def read_exactly() -> Callable[..., pd.DataFrame]:
    """Return pandas' reader of CSV with every digit kept: versions before 3 must be told so."""
    old = Version(pd.__version__) < Version("3")
    return partial(pd.read_csv, **({"float_precision": "round_trip"} if old else {}))


@pytest.fixture(scope="session")
def checker() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Return the function that runs an installed checker; skips where it is not installed."""

    def run(command: str, *arguments: object) -> subprocess.CompletedProcess[str]:
        program = Path(sys.executable).with_name(command)
        if not program.exists():
            pytest.skip(f"{command} is not installed")
        return subprocess.run(  # noqa: S603  # a checker from the test extra
            [str(program), *map(str, arguments)], capture_output=True, text=True, check=False
        )

    return run


@pytest.fixture
def consented_protocol(tmp_path: Path) -> Callable[..., Path]:
    """Return the function that writes the four-lap protocol with a consent."""

    def write(*, sharing: bool) -> Path:
        path = tmp_path / "consented.yaml"
        consent = f"consent: {{version: v1, text: I agree, sharing: {str(sharing).lower()}}}\n"
        path.write_text(shipped_text("four-lap") + consent)
        resolve_study(str(path))
        return path

    return write
