"""Find a protocol, a course or an instrument: a shipped name, or a file."""

from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Literal

from protocols.files.document import MAX_BYTES, Document, parse
from protocols.files.errors import InputError
from protocols.files.suggestion import allowed

Kind = Literal["studies", "courses", "instruments", "mappings"]
_KINDS: tuple[Kind, ...] = ("studies", "courses", "instruments", "mappings")
_WORD = {
    "studies": "protocol",
    "courses": "course",
    "instruments": "instrument",
    "mappings": "mapping",
}
_SUFFIXES = (".yaml", ".yml")


@dataclass(frozen=True, slots=True)
class Source:
    """A file that was found.

    Attributes
    ----------
    label
        How messages name it.
    file
        The file itself.
    folder
        Where relative paths inside it start; None for a shipped file.
    """

    label: str
    file: Traversable
    folder: Path | None

    def text(self) -> bytes:
        """Return the content, or its beginning where it is too large; ``InputError`` when none."""
        try:
            with self.file.open("rb") as opened:
                return opened.read(MAX_BYTES + 1)
        except OSError as error:
            raise InputError(f"{self.label}: cannot be read: {error.strerror}") from None

    def document(self) -> Document:
        """Return the content as YAML; ``InputError`` when it is none."""
        content = self.text()
        size = self.file.stat().st_size if isinstance(self.file, Path) else len(content)
        return parse(content, self.label, max(size, len(content)))


def shipped_names(kind: Kind) -> tuple[str, ...]:
    """Return the names of what comes with the package, sorted."""
    names = (file.name for file in files("protocols").joinpath(kind).iterdir())
    return tuple(sorted(n.removesuffix(".yaml") for n in names if n.endswith(".yaml")))


def locate(kind: Kind, name_or_path: str, folder: Path | None = None) -> Source:
    """Find a file by a shipped name or a path; a shipped name wins.

    Parameters
    ----------
    kind
        What to find.
    name_or_path
        As a person gave it.
    folder
        Where a relative path starts; None for the current directory.

    Raises
    ------
    InputError
        When there is no such file; lists what is shipped.
    """
    shipped = shipped_names(kind)
    if name_or_path in shipped:
        name = f"{name_or_path}.yaml"
        return Source(name, files("protocols").joinpath(kind, name), None)
    path = Path(name_or_path) if folder is None else folder / name_or_path
    try:
        if path.is_file():
            return Source(str(path), path, path.parent)
        is_folder = path.is_dir()
    except (OSError, ValueError):  # a name too long, or with a null character in it
        is_folder = False
    looks_like_path = len(Path(name_or_path).parts) > 1 or path.suffix in _SUFFIXES
    if is_folder and name_or_path:
        what = f"{name_or_path}: is a folder, not a {_WORD[kind]} file"
    elif looks_like_path:
        what = f"{name_or_path}: no such file"
    else:
        what = f"no {_WORD[kind]} is named {name_or_path!r}"
    raise InputError(f"{what}; {allowed(path.stem, shipped, ['a file'])}")


def locate_any(name_or_path: str) -> Source:
    """Find a file of any kind by a shipped name or a path; a shipped name wins.

    Raises
    ------
    InputError
        When there is no such file; lists the protocols that ship.
    """
    return _shipped(name_or_path) or locate("studies", name_or_path)


def _shipped(name: str) -> Source | None:
    kind = next((kind for kind in _KINDS if name in shipped_names(kind)), None)
    return None if kind is None else locate(kind, name)


def locate_text(name: str, folder: Path | None) -> str:
    """Return a text file's content; its path starts in a folder, or in the current one.

    Raises
    ------
    InputError
        When it cannot be read, is empty, too large or not UTF-8.
    """
    path = Path(name) if folder is None else folder / name
    try:
        if path.exists() and not path.is_file():
            raise InputError(f"{name}: is not a file; allowed: a text file")
        with path.open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
        text = content.decode("utf-8-sig")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it is not UTF-8 text"
        raise InputError(f"{name}: cannot be read: {reason}") from None
    if len(content) > MAX_BYTES or not text.strip():
        what = f"holds more than {MAX_BYTES} bytes" if len(content) > MAX_BYTES else "is empty"
        raise InputError(f"{name}: {what}; allowed: a text file")
    return text


def shipped_text(name: str) -> str:
    """Return a shipped file of any kind unchanged, comments included.

    Raises
    ------
    InputError
        When no shipped file has this name; lists the names there are.
    """
    source = _shipped(name)
    if source is not None:
        return source.text().decode()
    every = [shipped for kind in _KINDS for shipped in shipped_names(kind)]
    raise InputError(
        f"no shipped protocol, course or instrument is named {name!r}; {allowed(name, every)}"
    )
