"""A YAML file as plain data with the line of every value."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from protocols.files.errors import InputError
from protocols.files.fault import Fault, Location
from protocols.files.nodes import MAX_DEPTH, Node, compose, too_deep
from protocols.files.scalars import MERGE, TAG, ScalarError, scalar_value, short

MAX_BYTES = 2_000_000
_NO_TEXT = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""A character that YAML does not allow."""


@dataclass(frozen=True, slots=True)
class Document:
    """A file's data, and the line of every value in it.

    Attributes
    ----------
    source
        The file as messages name it.
    data
        Mappings, lists, text, numbers, truth values and None.
    lines
        Line (from 1) of every value by its location; of its key, where it has one.
    """

    source: str
    data: Any
    lines: Mapping[Location, int]

    def line(self, where: Location) -> int:
        """Return the line of a value, or of the nearest parent that is there."""
        while where not in self.lines and where:
            where = where[:-1]
        return self.lines.get(where, 1)

    def error(self, faults: Iterable[Fault]) -> InputError:
        """Return the faults, in the order of the file's lines, as an error to raise."""
        located = sorted((self.line(f.where), i, f) for i, f in enumerate(faults))
        return InputError(
            *(f"{self.source}:{line}: {_colon(f.where)}{f.message}" for line, _, f in located)
        )


def spoken(where: Location) -> str:
    """Write a location as a person would.

    Examples
    --------
    >>> spoken(("laps", 2, "condition"))
    'laps[2].condition'
    """
    text = "".join(
        f"[{part}]" if isinstance(part, int) else f".{short(part, 80)}" for part in where
    )
    return text.removeprefix(".")


def _colon(where: Location) -> str:
    return f"{spoken(where)}: " if where else ""


def parse(content: bytes, source: str, size: int | None = None) -> Document:
    """Read YAML 1.2.

    Parameters
    ----------
    content
        The file's, or the beginning of one that is too large.
    source
        The file as messages name it.
    size
        The file's size in bytes; None when ``content`` is all of it.

    Raises
    ------
    InputError
        When the content is not one YAML document of plain values: syntax, encoding, tags,
        repeated keys, merge keys, anchors that contain themselves or unfold without end; or is
        larger, longer or deeper than a file may be.
    """
    text = _decode(content, source, size if size is not None else len(content))
    root, version = compose(text, source)
    if root is None:
        raise InputError(f"{source}:1: the file is empty")
    unfolding = _Unfolding(source, version)
    data = unfolding.value(root, ())
    return Document(source, data, unfolding.lines)


def _decode(content: bytes, source: str, size: int) -> str:
    if size > MAX_BYTES:
        raise InputError(f"{source}: {size} bytes; a file may have {MAX_BYTES}")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        message = f"{source}:{line}: not UTF-8 text (byte 0x{content[error.start]:02x})"
        raise InputError(message) from None
    odd = _NO_TEXT.search(text)
    if odd is not None:
        line = text.count("\n", 0, odd.start()) + 1
        raise InputError(f"{source}:{line}: character U+{ord(odd[0]):04X} is not allowed")
    return text


@dataclass
class _Unfolding:
    """Turn nodes into plain values, noting lines and refusing what is not plain."""

    source: str
    version: tuple[int, int] | None
    lines: dict[Location, int] = field(default_factory=dict)
    open: set[int] = field(default_factory=set)

    def value(self, node: Node, where: Location) -> Any:
        self.lines.setdefault(where, node.line)
        if node.text is not None:
            return self.scalar(node, where)
        if id(node) in self.open:
            raise self.fault(node, where, "an anchor that contains itself is not allowed")
        if len(where) > MAX_DEPTH:
            raise too_deep(self.source, node.line)
        self.open.add(id(node))
        if node.tag == f"{TAG}seq":
            result: Any = [self.value(item, (*where, i)) for i, item in enumerate(node.items)]
        elif node.tag == f"{TAG}map":
            result = self.mapping(node, where)
        else:
            raise self.fault(node, where, f"the tag {short(node.tag)} is not allowed")
        self.open.remove(id(node))
        return result

    def mapping(self, node: Node, where: Location) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for key, item in zip(node.items[::2], node.items[1::2], strict=True):
            name = self.key(key, where)
            here = (*where, name)
            if name in result:
                first = self.lines[here]
                raise self.fault(key, here, f"given twice; it is in line {first} already")
            self.lines[here] = key.line
            result[name] = self.value(item, here)
        return result

    def key(self, key: Node, where: Location) -> str:
        if key.text is None:
            raise self.fault(key, where, "a field's name must be plain text")
        if key.tag == MERGE:
            raise self.fault(key, where, "'<<' is not supported; write the fields out")
        return key.text

    def scalar(self, node: Node, where: Location) -> Any:
        try:
            return scalar_value(node.tag, node.text or "", self.version)
        except ScalarError as error:
            raise self.fault(node, where, str(error)) from None

    def fault(self, node: Node, where: Location, message: str) -> InputError:
        return InputError(f"{self.source}:{node.line}: {_colon(where)}{message}")
