"""What a file's JSON Schema allows at a place in the file."""

from collections.abc import Mapping
from functools import cache
from typing import Any

from pydantic import BaseModel

from protocols.files.fault import Location

Schema = Mapping[str, Any]


@cache
def _schema_of(model: type[BaseModel]) -> Schema:
    return model.model_json_schema(by_alias=True)


def schema_at(model: type[BaseModel], where: Location) -> Schema:
    """Return the JSON Schema of a place in the file; empty where it has none."""
    root = _schema_of(model)
    schema = root
    for part in where:
        schema = _opened(schema, root)
        if isinstance(part, int):
            prefix = schema.get("prefixItems", ())
            schema = prefix[part] if part < len(prefix) else schema.get("items", {})
        else:
            schema = _field(schema, part)
    return _opened(schema, root)


def _field(schema: Schema, name: str) -> Schema:
    named = schema.get("properties", {}).get(name)
    any_name = next(iter(schema.get("patternProperties", {}).values()), None)
    return named or any_name or schema.get("additionalProperties") or {}


def _opened(schema: Any, root: Schema) -> Schema:
    """Follow references, and take the alternative that is not null."""
    while isinstance(schema, dict):
        if "$ref" in schema:
            schema = root["$defs"][schema["$ref"].rpartition("/")[2]]
        elif "anyOf" in schema and not {"properties", "items"} & schema.keys():
            others = [s for s in schema["anyOf"] if s.get("type") != "null"]
            if len(others) != 1:
                return schema
            schema = others[0]
        else:
            return schema
    return {}


def choices(schema: Schema) -> list[Any]:
    """Return the values a schema lists; none when it lists none."""
    if "const" in schema:
        return [schema["const"]]
    if "enum" in schema:
        return list(schema["enum"])
    return [choice for part in schema.get("anyOf", ()) for choice in choices(part)]


def number_range(schema: Schema) -> str:
    """Return the bounds of a number in words; empty when there are none."""
    words = {
        "exclusiveMinimum": "above",
        "minimum": "at least",
        "exclusiveMaximum": "below",
        "maximum": "at most",
    }
    return ", ".join(f"{word} {schema[key]:g}" for key, word in words.items() if key in schema)
