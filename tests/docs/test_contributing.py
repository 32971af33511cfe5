"""Who follows CONTRIBUTING.md alone ends with a part that a study can use."""

import re
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from typer.main import get_command

from harness.cli import main
from harness.cli.app import app

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
TARGETS = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))


def test_its_part_passes_check_part(tmp_path, monkeypatch, capsys):
    """The part is written where it says, and checked by the command that it gives."""
    for language, text in BLOCKS:
        if language == "python" and (name := re.match(r"# (\S+\.py)\n", text)):
            (tmp_path / name[1]).write_text(text)
    (line,) = (
        line for _, text in BLOCKS for line in text.splitlines() if " check-part near" in line
    )
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", line.split())
    with pytest.raises(SystemExit) as end:
        main()
    said = capsys.readouterr()
    assert end.value.code == 0, said.out + said.err
    assert "none failed" in said.out


def test_its_commands_exist():
    """Every make target and every command of ours that it names."""
    assert set(re.findall(r"`make ([\w-]+)`", PAGE)) <= TARGETS
    named = set(re.findall(r"`lad-study ([\w-]+)", PAGE)) - {"doctor"}
    assert named <= set(get_command(app).commands)


def test_the_hooks_before_a_commit_are_the_checks_of_ci():
    """`make check` and the hooks run the same programs, and fetch nothing."""
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text("utf-8"))["repos"]
    assert [repository["repo"] for repository in hooks] == ["local"]
    entries = {hook["entry"] for repository in hooks for hook in repository["hooks"]}
    recipe = (ROOT / "Makefile").read_text("utf-8").partition("\ncheck:")[2].partition("\n\n")[0]
    checked = {
        line.strip().replace("$(BIN)", ".venv/bin").removesuffix(" .")
        for line in recipe.splitlines()[1:]
    }
    assert entries == checked


def test_the_issue_forms_can_be_filled_in():
    """Every form has a name, and fields with ids that are there once; a bug asks for doctor."""
    forms = {
        path.stem: yaml.safe_load(path.read_text("utf-8"))
        for path in (ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml")
        if path.stem != "config"
    }
    assert set(forms) == {"bug", "part-proposal", "study-report"}
    for form in forms.values():
        assert form["name"]
        assert form["description"]
        ids = [field["id"] for field in form["body"]]
        assert len(ids) == len(set(ids))
    assert any("lad-study doctor" in f["attributes"]["label"] for f in forms["bug"]["body"])


def test_the_kinds_of_fragments_are_those_that_it_names():
    """What CONTRIBUTING.md calls a kind, towncrier knows."""
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["towncrier"]
    kinds = [kind["directory"] for kind in tool["type"]]
    (listed,) = re.findall(r"Kinds are ((?:`\w+`(?:, )?)+)", PAGE)
    assert re.findall(r"`(\w+)`", listed) == kinds
