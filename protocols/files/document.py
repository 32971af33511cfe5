"""A YAML file as plain data with the line of every value."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode
from ruamel.yaml.reader import ReaderError

from protocols.files.errors import InputError
from protocols.files.fault import Fault, Location

MAX_BYTES = 2_000_000
MAX_VALUES = 200_000
_TAG = "tag:yaml.org,2002:"
_NUMBERS = (f"{_TAG}int", f"{_TAG}float")
_TEXTS = (f"{_TAG}str", f"{_TAG}timestamp", f"{_TAG}value")
_CONSTANTS = {"true": True, "false": False, "yes": True, "no": False, "on": True, "off": False}


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
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in where)
    return text.removeprefix(".")


def _colon(where: Location) -> str:
    return f"{spoken(where)}: " if where else ""


def parse(content: bytes, source: str) -> Document:
    """Read YAML 1.2.

    Raises
    ------
    InputError
        When the content is not one YAML document of plain values: syntax, encoding, tags,
        repeated keys, merge keys, anchors that contain themselves or unfold without end.
    """
    text = _decode(content, source)
    root = _compose(text, source)
    if root is None:
        raise InputError(f"{source}:1: the file is empty")
    unfolding = _Unfolding(source)
    data = unfolding.value(root, ())
    return Document(source, data, unfolding.lines)


def _decode(content: bytes, source: str) -> str:
    if len(content) > MAX_BYTES:
        raise InputError(f"{source}: {len(content)} bytes; a file may have {MAX_BYTES}")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        message = f"{source}:{line}: not UTF-8 text (byte 0x{content[error.start]:02x})"
        raise InputError(message) from None


def _compose(text: str, source: str) -> Node | None:
    try:
        node: Node | None = YAML(typ="safe", pure=True).compose(text)
    except ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        message = f"{source}:{line}: character U+{ord(text[error.position]):04X} is not allowed"
        raise InputError(message) from None
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = min(mark.line, text.count("\n", 0, len(text) - 1)) + 1 if mark else 1
        what = f"{error.problem} {error.context or ''}"
        raise InputError(f"{source}:{line}: not YAML: {what}") from None
    except RecursionError:
        raise InputError(f"{source}: nested too deeply to be read") from None
    except (YAMLError, ValueError) as error:
        raise InputError(f"{source}: not YAML: {error}") from None
    return node


@dataclass
class _Unfolding:
    """Turn nodes into plain values, noting lines and refusing what is not plain."""

    source: str
    lines: dict[Location, int] = field(default_factory=dict)
    count: int = 0
    open: set[int] = field(default_factory=set)

    def value(self, node: Node, where: Location) -> Any:
        self.lines.setdefault(where, node.start_mark.line + 1)
        self.count += 1
        if self.count > MAX_VALUES:
            raise self.fault(node, where, f"unfolds to more than {MAX_VALUES} values")
        if isinstance(node, ScalarNode):
            return self.scalar(node, where)
        if id(node) in self.open:
            raise self.fault(node, where, "an anchor that contains itself is not allowed")
        self.open.add(id(node))
        if isinstance(node, SequenceNode) and node.tag == f"{_TAG}seq":
            result: Any = [self.value(item, (*where, i)) for i, item in enumerate(node.value)]
        elif isinstance(node, MappingNode) and node.tag == f"{_TAG}map":
            result = self.mapping(node, where)
        else:
            raise self.fault(node, where, f"the tag {_short(node.tag)} is not allowed")
        self.open.remove(id(node))
        return result

    def mapping(self, node: MappingNode, where: Location) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for key, item in node.value:
            name = self.key(key, where)
            here = (*where, name)
            if name in result:
                first = self.lines[here]
                raise self.fault(key, here, f"given twice; it is in line {first} already")
            self.lines[here] = key.start_mark.line + 1
            result[name] = self.value(item, here)
        return result

    def key(self, key: Node, where: Location) -> str:
        if not isinstance(key, ScalarNode):
            raise self.fault(key, where, "a field's name must be plain text")
        if key.tag == f"{_TAG}merge":
            raise self.fault(key, where, "'<<' is not supported; write the fields out")
        return self.text(key, where)

    def scalar(self, node: ScalarNode, where: Location) -> Any:
        if node.tag == f"{_TAG}null":
            return None
        if node.tag == f"{_TAG}bool" and node.value.lower() in _CONSTANTS:
            return _CONSTANTS[node.value.lower()]
        if node.tag in _TEXTS:
            return self.text(node, where)
        if node.tag in _NUMBERS:
            return self.number(node, where)
        raise self.fault(node, where, f"the tag {_short(node.tag)} is not allowed")

    def number(self, node: ScalarNode, where: Location) -> float:
        constructor = YAML(typ="safe", pure=True).constructor
        read = constructor.construct_yaml_int if node.tag == _NUMBERS[0] else (
            constructor.construct_yaml_float)  # fmt: skip
        try:
            number: float = read(node)
        except ValueError:
            raise self.fault(node, where, f"{_short(node.value)} is not a number") from None
        return number

    def text(self, node: ScalarNode, where: Location) -> str:
        text: str = node.value
        if any("\ud800" <= character <= "\udfff" for character in text):
            raise self.fault(node, where, "half a surrogate pair is not text")
        return text

    def fault(self, node: Node, where: Location, message: str) -> InputError:
        return InputError(f"{self.source}:{node.start_mark.line + 1}: {_colon(where)}{message}")


def _short(text: str | None) -> str:
    text = str(text)
    return text if len(text) <= 60 else f"{text[:57]}..."
