"""docs/architecture.md is true where a test can tell."""

import ast
import importlib
import re
import tomllib
from pathlib import Path

import pytest

from harness.cli.app import app

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
SEAMS = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \| `([\w/]+\.py)` \| (.+) \|$", PAGE, re.MULTILINE)
CONTRACTS = {
    contract["name"]: contract
    for contract in tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"][
        "contracts"
    ]
}


def test_every_file_it_names_is_there():
    """Paths in the text lead somewhere."""
    paths = re.findall(r"`((?:lad|protocols|participants|harness|analysis)/[\w/]*(?:\.py)?)`", PAGE)
    assert len(paths) > 30
    assert [path for path in paths if not (ROOT / path).exists()] == []


@pytest.mark.parametrize(("names", "file", "methods"), SEAMS)
def test_a_seam_has_the_methods_that_are_listed(names, file, methods):
    """Every protocol is where the table says, with these methods and no others."""
    module = importlib.import_module(file.removesuffix(".py").replace("/", "."))
    for name, listed in zip(re.findall(r"`(\w+)`", names), methods.split("; "), strict=True):
        tree = ast.parse(Path(module.__file__).read_text())
        body = next(n for n in tree.body if isinstance(n, ast.ClassDef) and n.name == name).body
        functions = [f for f in body if isinstance(f, ast.FunctionDef)]
        found = [f.name for f in functions if not f.decorator_list]
        assert found == re.findall(r"`(\w+)`", listed)


def test_the_wings_are_those_of_the_contract():
    """What the picture shows is what import-linter enforces."""
    (drawn,) = re.findall(r"^(cli(?:  ►  \w+)+)$", PAGE, re.MULTILINE)
    layers = CONTRACTS["The harness's wings stand on one another"]["layers"]
    enforced = [wing.removeprefix("harness.") for layer in layers for wing in layer.split(" | ")]
    assert [wing for wing in enforced if wing in drawn] == drawn.split("  ►  ")


def test_pybullet_is_imported_in_one_file():
    """And only two files import that one."""
    importing = {}
    for path in (ROOT / "harness").rglob("*.py"):
        names = {
            name
            for node in ast.walk(ast.parse(path.read_text()))
            for name in (
                [alias.name for alias in node.names] if isinstance(node, ast.Import)
                else [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            )
        }  # fmt: skip
        importing[path.relative_to(ROOT).as_posix()] = names
    assert [p for p, names in importing.items() if "pybullet" in names] == [
        "harness/world/bullet.py"
    ]
    assert {p for p, names in importing.items() if "harness.world.bullet" in names} == {
        "harness/world/bullet_world.py", "harness/world/bullet_caster.py"
    }  # fmt: skip


def test_every_command_has_a_file_of_the_wing():
    """One file per command, or per family of commands."""
    modules = {command.callback.__module__ for command in app.registered_commands}
    assert all(module.startswith("harness.cli.") for module in modules)


def test_nothing_else_indexes_the_planned_laps():
    """Which lap a participant drives at which place is asked of `laps_of` alone."""
    indexed = re.compile(r"protocol\.laps\[(?!:)")
    found = [
        path.relative_to(ROOT).as_posix()
        for package in ("protocols", "participants", "harness", "analysis")
        for path in (ROOT / package).rglob("*.py")
        if indexed.search(path.read_text(encoding="utf-8"))
    ]
    assert found == []
