"""Writes the reference pages that follow from the code: commands, files, parts, the record.

``python docs/write_reference.py`` writes ``docs/reference`` again; a test compares.
"""

import importlib
import json
from pathlib import Path
from typing import Any

import typer
from typer.cli import get_docs_for_click
from typer.main import get_command

from harness.cli.app import app
from participants.options import Options
from protocols.json_schema import WithMeanings, json_schemas
from protocols.record.codebook import codebook
from protocols.shipped_parts import SHIPPED

FOLDER = Path(__file__).parent / "reference"
WRITTEN = "<!-- Written by docs/write_reference.py; do not edit. -->\n"
IN_CELLS = {"|": "\\|", "\n": " ", "<": "&lt;"}


def main() -> None:
    """Write every page."""
    for name, text in pages().items():
        (FOLDER / name).write_text(text, encoding="utf-8")


def pages() -> dict[str, str]:
    """Return the text of every page by file name."""
    schemas = {name: json.loads(text) for name, text in json_schemas().items()}
    return {
        "commands.md": commands_page(),
        "protocol-file.md": fields_page(
            "Fields of a protocol file",
            "For people who write a protocol file and look up what a field may contain. What the "
            "parts mean together, with examples, is in [Protocols and records](../protocols.md).",
            schemas["protocol.json"],
        ),
        "instrument-file.md": fields_page(
            "Fields of an instrument file",
            "For people who write a questionnaire of their own. `lad-study show "
            "driving-assistance` prints one to copy.",
            schemas["instrument.json"],
        ),
        "course-file.md": fields_page(
            "Fields of a course file",
            "For people who lay out a course of their own. `lad-study show lab-office` prints one "
            "to copy; a robot's map becomes one by `lad-study import map` "
            "([In and out](../exchange.md)).",
            schemas["course.json"],
        ),
        "part-options.md": options_page(),
        "record.md": record_page(),
    }


def commands_page() -> str:
    """Return the page of all commands, as their own ``--help`` describes them."""
    command = get_command(app)
    context = typer.Context(command, info_name="lad-study")
    text = get_docs_for_click(obj=command, ctx=context, name="lad-study")
    _, _, below = text.partition("**Usage**")
    return (
        f"{WRITTEN}# Commands\n\n"
        "For people at a command line. This page has what `lad-study COMMAND --help` prints. Exit "
        "codes: 0 done; 1 something failed; 2 faulty input, with one line: where, what, and what "
        f"is allowed.\n\n**Usage**{below.rstrip()}\n"
    )


def fields_page(title: str, intro: str, schema: dict[str, Any]) -> str:
    """Return the page of a kind of file: a table of fields for each of its parts.

    Parameters
    ----------
    title, intro
        Heading, and the paragraph under it.
    schema
        The published JSON Schema, as a mapping.
    """
    parts = {schema["title"]: schema} | {
        name: part for name, part in schema.get("$defs", {}).items() if "properties" in part
    }
    lines = [WRITTEN + f"# {title}\n", intro + "\n"]
    lines.append(
        "Every field has an address of its own, such as "
        f"`#{schema['title'].lower()}.{next(iter(schema['properties']))}`.\n"
    )
    for name, part in parts.items():
        lines += [f"## {name}\n", part.get("description", "") + "\n"]
        lines += _table(name.lower(), part)
    return "\n".join(lines)


def _table(name: str, part: dict[str, Any]) -> list[str]:
    """Return the lines of a table of fields, each with an anchor that begins with a name."""
    lines = ["| field | what it may contain | default | meaning |", "|---|---|---|---|"]
    for field, value in part["properties"].items():
        default = "required" if field in part.get("required", ()) else _default(value)
        meaning = _cell(value.get("description", ""))
        lines.append(
            f'| <a id="{name}.{field}"></a>`{field}` | {_allowed(value)} | {default} | {meaning} |'
        )
    return [*lines, ""]


def _default(value: dict[str, Any]) -> str:
    if "default" not in value:
        return "none"
    default = value["default"]
    if default in ({}, [], ""):
        return "none"
    if isinstance(default, dict):
        return "see there"
    return f"`{json.dumps(default, ensure_ascii=False)}`".replace('"', "")


def _allowed(value: dict[str, Any]) -> str:
    """Return in words what a field may contain."""
    if "$ref" in value:
        name = value["$ref"].rpartition("/")[2]
        return f"[{name}](#{name.lower()})"
    if "anyOf" in value:
        return " or ".join(dict.fromkeys(_allowed(choice) for choice in value["anyOf"]))
    if "enum" in value:
        return ", ".join(f"`{choice}`" for choice in value["enum"])
    if "const" in value:
        return f"`{value['const']}`"
    return _of_type(value)


def _of_type(value: dict[str, Any]) -> str:
    kind = value.get("type")
    if kind == "array":
        return _list(value)
    if kind == "object":
        below = value.get("additionalProperties")
        if "patternProperties" in value:
            (below,) = value["patternProperties"].values()
        return f"names, each with {_allowed(below)}" if isinstance(below, dict) else "options"
    if kind == "string":
        if value.get("pattern", "").endswith(")?$"):
            return "another part's name, or `module:factory`"
        return "SHA-256" if value.get("pattern") == "^[0-9a-f]{64}$" else "text"
    words = {"number": "number", "integer": "whole number", "boolean": "`true`, `false`",
             "null": "`null`"}  # fmt: skip
    return words[str(kind)] + _range(value) if kind else "anything"


def _list(value: dict[str, Any]) -> str:
    if "prefixItems" in value:
        return "[" + ", ".join(_allowed(item) for item in value["prefixItems"]) + "]"
    least, most = value.get("minItems"), value.get("maxItems")
    count = f" ({least or 0} to {most})" if most else f" ({least} or more)" if least else ""
    return f"list of {_allowed(value['items'])}{count}"


def _range(value: dict[str, Any]) -> str:
    words = [
        f"{word} {value[key]:g}"
        for key, word in (
            ("minimum", "from"),
            ("exclusiveMinimum", "above"),
            ("maximum", "to"),
            ("exclusiveMaximum", "below"),
        )
        if key in value
    ]
    return ", " + " ".join(words) if words else ""


def options_page() -> str:
    """Return the page of the options of the parts that ship, a table for each part."""
    lines = [
        WRITTEN + "# Options of the parts that ship\n",
        (
            "For people who write a protocol file. A driver, demonstrator, respondent or "
            "impairment is named by `use`; these are its `options`. Models take `parameters` "
            "([LADParameters](protocol-file.md#ladparameters)), or keyword arguments of the "
            "factory in the table.\n"
        ),
    ]
    for role, parts in SHIPPED.items():
        options = {name: _options_of(factory) for name, factory in parts.items()}
        lines += [f"## {role}\n", "| `use` | made by | options |", "|---|---|---|"]
        lines += [
            f"| `{name}` | `{parts[name]}` | {f'[below](#{role}-{name})' if model else '–'} |"
            for name, model in options.items()
        ]
        lines.append("")
        for name, model in options.items():
            if model:
                lines += _part(f"{role} {name}", model)
    return "\n".join(lines)


def _part(title: str, model: type[Options]) -> list[str]:
    """Return the tables of a part's options, and of what is nested in them."""
    schema = model.model_json_schema(schema_generator=WithMeanings)
    lines = [f"### {title}\n", *_table(title.replace(" ", "-"), schema)]
    for name, below in schema.get("$defs", {}).items():
        lines += [f"#### {name}\n", below["description"] + "\n", *_table(name.lower(), below)]
    return lines


def _options_of(factory: str) -> type[Options] | None:
    """Return the options that the module of a shipped factory defines."""
    module = importlib.import_module(factory.partition(":")[0])
    found = [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Options)
        and value.__module__ == module.__name__
    ]  # fmt: skip
    return found[0] if found else None


def record_page() -> str:
    """Return the page of the record: every column of every table, from the codebook."""
    book = codebook()
    lines = [
        WRITTEN + "# The record\n",
        (
            "For people who analyse a study with their own tools. These are the columns of the "
            f"Parquet files in a study directory, schema version {book['schema']}; every study "
            "directory has the same in `codebook.json`. How the files lie is in "
            "[The study directory](../protocols.md#the-study-directory).\n"
        ),
    ]
    for name, columns in book["tables"].items():
        lines += [f"## {name}\n"]
        lines += ["| column | type | unit | meaning | allowed | may be missing | since |",
                  "|---|---|---|---|---|---|---|"]  # fmt: skip
        lines += [
            f'| <a id="{name}.{c["name"]}"></a>`{c["name"]}` | {c["type"]} | {c["unit"]} '
            f"| {_cell(c['description'])} | {_cell(c['allowed'])} "
            f"| {'yes' if c['nullable'] else 'no'} | {c['since']} |"
            for c in columns
        ]
        lines.append("")
    return "\n".join(lines)


def _cell(text: str) -> str:
    """Return text for a cell of a table."""
    for mark, written in IN_CELLS.items():
        text = text.replace(mark, written)
    return text


if __name__ == "__main__":
    main()
