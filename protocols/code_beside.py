"""Python code beside a protocol file: which files it is, and a digest of its content."""

import ast
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

MAX_CODE_BYTES = 2_000_000
"""A module beside a protocol is not larger."""


@dataclass(frozen=True, slots=True)
class PartBeside:
    """A part whose factory is in a module beside the protocol file.

    Attributes
    ----------
    place
        Where the protocol names it: file, line and field.
    use
        As the protocol has it, ``module:factory``.
    module
        The module's file.
    digest
        SHA-256 of that file and of the files beside it that it imports.
    """

    place: str
    use: str
    module: Path
    digest: str


def module_beside(folder: Path, use: str) -> Path | None:
    """Return the file of a module that ``use`` names; None when there is none in the folder.

    Parameters
    ----------
    folder
        The protocol file's.
    use
        ``module:factory``; the module is one name, for it is one file.
    """
    module, colon, _ = use.partition(":")
    path = folder / f"{module}.py"
    return path.resolve() if colon and module.isidentifier() and path.is_file() else None


def code_digest(module: Path) -> str:
    """Return the SHA-256 of a module and of everything beside it that it imports.

    Raises
    ------
    OSError
        When one of the files cannot be read.
    """
    digest = hashlib.sha256()
    for path in sorted(_with_imports(module)):
        content = path.read_bytes()
        digest.update(f"{path.name} {len(content)}\n".encode())
        digest.update(content)
    return digest.hexdigest()


def _with_imports(module: Path) -> set[Path]:
    found, left = set[Path](), [module]
    while left:
        path = left.pop()
        if path not in found:
            found.add(path)
            beside = (path.parent / f"{name}.py" for name in _imported(path))
            left += [other for other in beside if other.is_file()]
    return found


def _imported(path: Path) -> Iterator[str]:
    """Yield the first name of every module that a file imports, anywhere in it."""
    with path.open("rb") as file:
        text = file.read(MAX_CODE_BYTES)
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):  # reported when it is loaded
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module.partition(".")[0]
