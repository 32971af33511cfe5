"""Draft a mapping from what is in a questionnaire export."""

import csv
import re
from collections import Counter
from pathlib import Path

from protocols.files.errors import InputError

_LAP_AND_ITEM = re.compile(r"^(?P<a>\D*)(?P<lap>\d+)(?P<b>[^A-Za-z0-9]+)(?P<item>[A-Za-z]\w*)$")
_ITEM_AND_LAP = re.compile(r"^(?P<item>[A-Za-z]\w*?)(?P<b>[^A-Za-z0-9]+)(?P<a>\D*)(?P<lap>\d+)$")
MOST_LABELS = 30
"""More different texts than this are no labels of a scale."""

_WHO = re.compile(r"participant|subject|record_?id|prolific|code|^id$|\bid\b", re.IGNORECASE)
_BYTE_ORDER_MARKS = (b"\xff\xfe", b"\xfe\xff")


def guess_mapping(file: Path) -> str:
    """Return the text of a mapping to look at and to correct.

    Raises
    ------
    InputError
        When the file cannot be read, or has no table in it.
    """
    text, encoding = _decoded(file)
    head = text.splitlines()[:1] or [""]
    separator = max(",;\t", key=head[0].count)
    rows = list(csv.reader(text.splitlines(), delimiter=separator))
    if not rows or len(rows[0]) < 2:
        raise InputError(f"{file}:1: no table with names in its first row")
    names = rows[0]
    who = next((name for name in names if _WHO.search(name)), names[0])
    qualtrics = len(rows) > 2 and any("ImportId" in value for value in rows[2])
    first, lines, columns = _layout(names)
    labels = _labels(names, rows[3 if qualtrics else 1 :], columns)
    return "\n".join(
        [
            f"# Drafted from {file.name}: look through it and correct it.",
            "schema: 1",
            f"participant: {{column: {_yaml(who)}}}",
            "instrument: driving-assistance   # the study's name of what was asked",
            *lines,
            f"first_lap: {first}                     # number of the session's first lap here",
            *(["skip_rows: 2                   # Qualtrics: wording and import ids"] if qualtrics
              else []),
            *([f"labels: {{{', '.join(f'{_yaml(t)}: null' for t in labels)}}}   # fill in"]
              if labels else []),
            f"encoding: {encoding}",
            f"separator: {_yaml(separator)}",
            "",
        ]
    )  # fmt: skip


def _decoded(file: Path) -> tuple[str, str]:
    try:
        content = file.read_bytes()
    except OSError as error:
        raise InputError(f"{file}: cannot be read: {error.strerror}") from None
    # Any bytes of an even number are UTF-16: only a byte order mark tells.
    wide = ["utf-16"] if content.startswith(_BYTE_ORDER_MARKS) else []
    for encoding in (*wide, "utf-8-sig", "cp1252"):
        try:
            return content.decode(encoding), encoding.removesuffix("-sig")
        except UnicodeDecodeError:
            continue
    return content.decode("latin-1"), "latin-1"


def _layout(names: list[str]) -> tuple[int, list[str], list[str]]:
    """Return the smallest lap number, how the answers lie, and the columns with answers."""
    for pattern in (_LAP_AND_ITEM, _ITEM_AND_LAP):
        found = [m for m in map(pattern.match, names) if m]
        shapes = Counter((m["a"], m["b"]) for m in found)
        if not shapes:
            continue
        (a, b), count = shapes.most_common(1)[0]
        if count < 2:
            continue
        parts = f"{a}{{lap}}{b}{{item}}" if pattern is _LAP_AND_ITEM else f"{{item}}{b}{a}{{lap}}"
        alike = [m for m in found if (m["a"], m["b"]) == (a, b)]
        first = min(int(m["lap"]) for m in alike)
        return first, [f"wide: {{columns: {_yaml(parts)}}}"], [m.string for m in alike]
    lowered = {name.lower(): name for name in names}
    columns = {
        part: next((lowered[n] for n in words if n in lowered), f"COLUMN-WITH-THE-{part.upper()}")
        for part, words in (
            ("item", ("item", "question")),
            ("answer", ("answer", "response", "value")),
            ("lap", ("lap", "round", "trial", "round_number")),
        )
    }
    listed = ", ".join(f"{part}: {_yaml(name)}" for part, name in columns.items())
    return 0, [f"long: {{{listed}}}"], [columns["answer"]]


def _labels(names: list[str], answers: list[list[str]], columns: list[str]) -> list[str]:
    """Return the answers that are no numbers; none where there are too many to be labels."""
    places = [names.index(name) for name in columns if name in names]
    given = {row[i].strip() for row in answers for i in places if i < len(row)}
    labels = sorted(text for text in given if text and not re.fullmatch(r"[\d.,-]+", text))
    return labels if len(labels) <= MOST_LABELS else []


def _yaml(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\t", "\\t") + '"'
