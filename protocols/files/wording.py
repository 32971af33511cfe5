"""What pydantic found, in the terms of the file."""

from collections.abc import Callable, Mapping
from typing import Any

from pydantic import BaseModel

from protocols.files.fault import Location
from protocols.files.json_schema_at import choices, number_range, schema_at
from protocols.files.suggestion import allowed

Item = Mapping[str, Any]
"""One entry of pydantic's ``ValidationError.errors()``."""

_WANTED = {
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "int_parsing": "a whole number",
    "int_parsing_size": "a whole number of reasonable size",
    "float_type": "a number",
    "float_parsing": "a number",
    "finite_number": "a finite number",
    "string_type": "text (put it in quotes)",
    "bool_type": "true or false",
    "tuple_type": "a list",
    "list_type": "a list",
    "dict_type": "a mapping of names to values",
    "model_type": "a mapping of fields",
    "model_attributes_type": "a mapping of fields",
}


def worded(item: Item, where: Location, model: type[BaseModel]) -> str:
    """Return one line: what was given, and what is allowed.

    Parameters
    ----------
    item
        As pydantic reports it.
    where
        The place in the file.
    model
        What the whole file was checked against.
    """
    kind = item["type"]
    if kind in _WANTED:
        return f"must be {_WANTED[kind]}; given {shown(item['input'])}"
    if kind in _SENTENCES:
        return _SENTENCES[kind](item, where, model)
    if kind in ("value_error", "assertion_error"):
        cause = str(item["ctx"]["error"])
        general = cause.startswith("Input should")
        return f"{cause}; given {shown(item['input'])}" if general else cause
    return f"{item['msg']}; given {shown(item['input'])}"


def shown(value: Any) -> str:
    """Return a value of a file, short enough for a message."""
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, list):
        return "a list"
    if value is None:
        return "nothing"
    text = str(value).lower() if isinstance(value, bool) else repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _missing(_: Item, __: Location, ___: type[BaseModel]) -> str:
    return "missing; it must be given"


def _unknown_field(_: Item, where: Location, model: type[BaseModel]) -> str:
    fields = schema_at(model, where[:-1]).get("properties", {})
    return f"unknown field; {allowed(str(where[-1]), fields)}"


def _out_of_range(item: Item, where: Location, model: type[BaseModel]) -> str:
    bounds = number_range(schema_at(model, where)) or item["msg"]
    return f"{shown(item['input'])} is out of range; allowed: {bounds}"


def _no_choice(item: Item, where: Location, model: type[BaseModel]) -> str:
    names = [str(choice) for choice in choices(schema_at(model, where))]
    return f"{shown(item['input'])} is not allowed here; {allowed(str(item['input']), names)}"


def _no_name(item: Item, _: Location, __: type[BaseModel]) -> str:
    inside = item["ctx"]["pattern"].rpartition("[")[2].partition("]")[0]
    marks = {" ": "space", "_": "_", ".": ".", "-": "-"}
    words = [word for mark, word in marks.items() if mark in inside.replace("A-Za-z0-9", "")]
    return f"{shown(item['input'])} is not a name; allowed: letters, digits, {', '.join(words)}"


def _too_short(item: Item, _: Location, __: type[BaseModel]) -> str:
    ctx = item["ctx"]
    return f"has {ctx['actual_length']} entries; allowed: at least {ctx['min_length']}"


def _too_long(item: Item, _: Location, __: type[BaseModel]) -> str:
    ctx = item["ctx"]
    return f"has more entries than allowed; allowed: at most {ctx['max_length']}"


def _empty(_: Item, __: Location, ___: type[BaseModel]) -> str:
    return "must not be empty"


_SENTENCES: dict[str, Callable[[Item, Location, type[BaseModel]], str]] = {
    "missing": _missing,
    "extra_forbidden": _unknown_field,
    "greater_than": _out_of_range,
    "greater_than_equal": _out_of_range,
    "less_than": _out_of_range,
    "less_than_equal": _out_of_range,
    "literal_error": _no_choice,
    "string_pattern_mismatch": _no_name,
    "too_short": _too_short,
    "too_long": _too_long,
    "string_too_short": _empty,
}
