"""The command line as a whole."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from rich.console import Console


def test_without_a_command_the_commands_are_listed(lad_study):
    """As help, on lines of their own."""
    said = lad_study()
    assert said.code == 0
    assert said.err == ""
    for command in ("run", "report", "reproduce", "replay", "validate", "check", "show"):
        assert any(line.strip().startswith(f"{command} ") for line in said.out.splitlines())


def test_help_and_version_come_before_any_command(lad_study):
    """The same help when asked for; a version without it."""
    assert lad_study("--help").out == lad_study().out
    said = lad_study("--version")
    assert said.out.startswith("lad-study ")
    assert "Commands" not in said.out


def _outside(*arguments, cwd, before="pass", **environment):
    """Run the command line in a process of its own, without the working directory in its path."""
    code = f"{before}; from harness.cli import main; main()"
    return subprocess.run(  # noqa: S603  # our own command
        [sys.executable, "-P", "-c", code, *map(str, arguments)],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[3]), **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def test_a_terminal_that_knows_ascii_alone_gets_ascii(tmp_path):
    """Letters it does not know are written by their numbers; nothing breaks."""
    (tmp_path / "ü.yaml").write_text("schema: 1\n")
    plain = {"LC_ALL": "C", "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    said = _outside("validate", "ü.yaml", cwd=tmp_path, **plain)
    assert said.returncode == 2
    assert said.stderr.isascii()
    assert ".yaml:1: " in said.stderr
    assert said.stderr.count("\n") == 1


def test_a_working_directory_that_is_gone_is_no_traceback(tmp_path):
    """One line says so."""
    gone = "import os; os.mkdir('gone'); os.chdir('gone'); os.rmdir('../gone')"
    said = _outside("validate", "mine.yaml", cwd=tmp_path, before=gone)
    assert said.returncode == 2
    assert said.stderr == "the working directory is not there any more; go to another\n"


@pytest.mark.parametrize("command", ["run", "report", "check", "validate"])
def test_a_path_that_nothing_can_have_is_an_input_fault(lad_study, command):
    """Named, shortened, exit code 2."""
    path = "x" * 5000
    said = lad_study(command, "--out", path) if command == "run" else lad_study(command, path)
    assert said.code == 2
    assert said.err.count("\n") == 1
    assert len(said.err) < 1500


def test_a_table_in_a_narrow_terminal_keeps_its_numbers(capsys, monkeypatch):
    """A number that is cut is another number."""
    from rich.table import Table

    from harness.cli import console

    monkeypatch.setenv("COLUMNS", "40")
    monkeypatch.setattr(console, "OUT", Console())
    table = Table("condition", "a long heading", "another long heading", "one more")
    table.add_row("a condition with a long name", "12345.678", "9876.54321", "100.25%")
    console.print_table(table)
    said = capsys.readouterr().out
    for number in ("12345.678", "9876.54321", "100.25%"):
        assert number in said


def test_sigterm_is_said_and_leaves_nothing(tmp_path):
    """One line, code 143, and an empty temporary directory."""
    (tmp_path / "tmp").mkdir()
    code = "from harness.cli import main; main()"
    with subprocess.Popen(  # noqa: S603  # our own command
        [sys.executable, "-c", code, "run", "--participants", "2", "--out", "study"],
        cwd=tmp_path,
        env={
            **os.environ,
            "PYTHONPATH": str(Path(__file__).parents[3]),
            "TMPDIR": str(tmp_path / "tmp"),
        },
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        before = ""
        while "Sessions 0/2" not in before:
            before += process.stderr.readline()
            assert process.poll() is None, before + process.stderr.read()
        process.terminate()
        _, err = process.communicate(timeout=60)
    assert process.returncode == 143
    assert err.strip().splitlines() == ["lad-study: stopped by SIGTERM. What was finished is kept."]
    assert list((tmp_path / "tmp").iterdir()) == []


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_can_complete_commands(shell):
    """The script it asks for names the program; and the program answers with commands."""
    script = _completed({"_LAD_STUDY_COMPLETE": f"source_{shell}"}).stdout
    assert "_LAD_STUDY_COMPLETE=complete_" in script
    asked = {
        "_LAD_STUDY_COMPLETE": f"complete_{shell}",
        "COMP_WORDS": "lad-study pre",
        "COMP_CWORD": "1",
        "_TYPER_COMPLETE_ARGS": "lad-study pre",
        "_TYPER_COMPLETE_FISH_ACTION": "get-args",
        "_TYPER_COMPLETE_WORD_TO_COMPLETE": "pre",
    }
    assert "preregister" in _completed(asked).stdout


def _completed(environment):
    command = [sys.executable, "-c", "from harness.cli import main; main()"]
    return subprocess.run(  # noqa: S603  # our own code
        command, env=os.environ | environment, capture_output=True, text=True, check=False
    )
