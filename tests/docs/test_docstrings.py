"""What the Python reference lists is documented."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODULES = sorted(
    ROOT / f"{module.replace('.', '/')}.py"
    for page in (ROOT / "docs" / "reference" / "api").glob("*.md")
    for module in re.findall(r"^```\{automodule\} (\S+)$", page.read_text("utf-8"), re.MULTILINE)
    if (ROOT / f"{module.replace('.', '/')}.py").is_file()
)


def public_functions(path):
    """Return a module's public functions with their docstrings."""
    tree = ast.parse(path.read_text("utf-8"))
    found = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    return [(node, ast.get_docstring(node)) for node in found if not node.name.startswith("_")]


@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.relative_to(ROOT).as_posix())
def test_a_function_describes_what_it_takes_and_raises(path):
    """Parameters have a section that names each, and an error that is raised is named."""
    for function, text in public_functions(path):
        names = [a.arg for a in (*function.args.args, *function.args.kwonlyargs)]
        section = text.partition("Parameters\n---")[2]
        unnamed = [
            name for name in names if not re.search(rf"^.*\b{name}\b", section, re.MULTILINE)
        ]
        assert not unnamed, f"{function.name}: {unnamed}"
        raised = {
            node.exc.func.id
            for node in ast.walk(function)
            if isinstance(node, ast.Raise)
            and isinstance(node.exc, ast.Call)
            and isinstance(node.exc.func, ast.Name)
            and not node.exc.func.id.startswith("_")
        }
        assert raised <= set(re.findall(r"\w+", text)), function.name
