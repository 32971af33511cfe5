"""A YAML text as nodes with their lines, within limits that no file of ours comes near.

Read by libyaml, event by event: whatever is too much is refused as soon as it is seen.
"""

from dataclasses import dataclass, field
from typing import Any

import yaml

from protocols.files.errors import InputError
from protocols.files.scalars import TAG, short, tag_of

MAX_DEPTH = 50
"""How deep lists and mappings may be nested."""

MAX_VALUES = 100_000
"""How many values a file may have, repeated ones counted as often as they stand for."""


@dataclass(slots=True)
class Node:
    """A scalar (``text``), or a list or mapping (``items``: entries; keys and values in turn)."""

    tag: str
    line: int
    text: str | None = None
    items: list["Node"] = field(default_factory=list)
    values: int = 1
    """How many values it stands for, itself and repeated ones included."""


@dataclass(slots=True)
class _Composer:
    """Puts the events of one document together."""

    source: str
    version: tuple[int, int] | None = None
    root: Node | None = None
    count: int = 0
    open: list[Node] = field(default_factory=list)
    anchors: dict[str, Node] = field(default_factory=dict)

    def take(self, event: Any) -> None:
        if isinstance(event, yaml.DocumentStartEvent):
            if self.root is not None:
                raise self.fault(event, "but found another document; one is allowed")
            self.version = event.version
        elif isinstance(event, yaml.AliasEvent):
            if event.anchor not in self.anchors:
                raise self.fault(event, f"found undefined alias '{short(event.anchor)}'")
            self.add(self.anchors[event.anchor], event)
        elif isinstance(event, yaml.ScalarEvent):
            self.add(Node(self.tag(event), _line(event), event.value), event)
        elif isinstance(event, yaml.SequenceStartEvent | yaml.MappingStartEvent):
            kind = "seq" if isinstance(event, yaml.SequenceStartEvent) else "map"
            plain = event.tag in {None, "!"}
            node = Node(f"{TAG}{kind}" if plain else event.tag, _line(event))
            self.add(node, event)
            self.open.append(node)
            if len(self.open) > MAX_DEPTH:
                raise too_deep(self.source, _line(event))
        elif isinstance(event, yaml.SequenceEndEvent | yaml.MappingEndEvent):
            self.close(self.open.pop())

    def close(self, node: Node) -> None:
        """Count what a list or mapping unfolds to: an anchor's values as often as it is used."""
        values = node.items[1::2] if node.tag == f"{TAG}map" else node.items
        node.values += sum(value.values for value in values)
        if node.values > MAX_VALUES:
            message = f"expands to more than {MAX_VALUES} values"
            raise InputError(f"{self.source}:{node.line}: {message}")

    def add(self, node: Node, event: Any) -> None:
        self.count += 1
        if self.count > 2 * MAX_VALUES:  # a field's name is a node, too
            raise InputError(f"{self.source}: has more than {MAX_VALUES} values")
        if event.anchor is not None and not isinstance(event, yaml.AliasEvent):
            self.anchors[event.anchor] = node
        if self.open:
            self.open[-1].items.append(node)
        else:
            self.root = node

    def tag(self, event: Any) -> str:
        if event.tag not in {None, "!"}:
            return str(event.tag)
        return tag_of(event.value, self.version) if event.implicit[0] else f"{TAG}str"

    def fault(self, event: Any, message: str) -> InputError:
        return InputError(f"{self.source}:{_line(event)}: not YAML: {message}")


def compose(text: str, source: str) -> tuple[Node | None, tuple[int, int] | None]:
    """Return a text's one document, and the version of YAML that it declares.

    Raises
    ------
    InputError
        When it is not YAML, or too much of it.
    """
    composer = _Composer(source)
    try:
        for event in yaml.parse(text, Loader=yaml.CSafeLoader):
            composer.take(event)
    except yaml.reader.ReaderError as error:
        raise InputError(f"{source}: not YAML: {error.reason}") from None
    except yaml.MarkedYAMLError as error:
        if "nesting depth" in str(error.problem):
            raise too_deep(source, 1) from None
        mark = error.problem_mark or error.context_mark
        line = min(mark.line, text.count("\n", 0, len(text) - 1)) + 1 if mark else 1
        what = short(f"{error.problem} {error.context or ''}".strip(), 200)
        raise InputError(f"{source}:{line}: not YAML: {what}") from None
    except (yaml.YAMLError, ValueError) as error:
        raise InputError(f"{source}: not YAML: {short(str(error), 200)}") from None
    root = composer.root
    empty = root is not None and root.text == "" and root.tag == f"{TAG}null"
    return (None if empty else root), composer.version


def too_deep(source: str, line: int) -> InputError:
    """Return the refusal of what is nested too deeply."""
    return InputError(f"{source}:{line}: nested too deeply; allowed: {MAX_DEPTH} levels")


def _line(event: Any) -> int:
    line: int = event.start_mark.line + 1
    return line
