"""The command line, called in this process."""

import sys
from typing import NamedTuple

import pytest

from harness.cli import main


class Said(NamedTuple):
    """What a command printed, and its exit code."""

    code: int
    out: str
    err: str


@pytest.fixture
def lad_study(monkeypatch, capsys, tmp_path):
    """Call ``lad-study`` with these arguments, in a folder of its own."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        monkeypatch.setattr(sys, "argv", ["lad-study", *map(str, arguments)])
        capsys.readouterr()
        with pytest.raises(SystemExit) as end:
            main()
        return Said(end.value.code, *capsys.readouterr())

    return call
