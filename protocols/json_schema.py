"""The JSON Schemas of the files people write, for editors and other programs.

``python -m protocols.json_schema docs/schema`` writes the published files again.
"""

import json
import sys
from pathlib import Path

from pydantic import BaseModel
from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue
from pydantic_core import core_schema

from protocols.course.schema import Course
from protocols.files.field_meanings import field_meanings, summary_of
from protocols.instrument import Instrument
from protocols.study import StudyProtocol

_DIALECT = "https://json-schema.org/draft/2020-12/schema"
_MODELS: dict[str, type[BaseModel]] = {
    "protocol.json": StudyProtocol,
    "course.json": Course,
    "instrument.json": Instrument,
}


def json_schemas() -> dict[str, str]:
    """Return the text of every published schema by file name.

    They define what each field may contain. Only ``lad-study validate`` checks that the parts of a
    file agree with one another.
    """
    return {name: _text(model) for name, model in _MODELS.items()}


class WithMeanings(GenerateJsonSchema):
    """Takes the description of each field from its model's docstring."""

    def model_schema(self, schema: core_schema.ModelSchema) -> JsonSchemaValue:
        """Return a model's schema with its summary, and each field's meaning."""
        described = super().model_schema(schema)
        model: type[BaseModel] = schema["cls"]
        for name, meaning in field_meanings(model).items():
            shown = model.model_fields[name].alias or name
            described["properties"][shown]["description"] = meaning
        return {**described, "description": summary_of(model)}


def _text(model: type[BaseModel]) -> str:
    made = model.model_json_schema(by_alias=True, schema_generator=WithMeanings)
    schema = {"$schema": _DIALECT, **made}
    return json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


def write_json_schemas(folder: Path) -> None:
    """Write every published schema into a folder that exists."""
    for name, text in json_schemas().items():
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write_json_schemas(Path(sys.argv[1]))
