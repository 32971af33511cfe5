"""A Psych-DS dataset: CSV files named by keywords, described in the words of schema.org.

Specification: https://psych-ds.readthedocs.io/ (version 1.4.0). A data file must be called
``*_data.csv``; a tool ignores any other without a word.
"""

import json
from pathlib import Path
from typing import Any

from analysis.export.content import Content
from analysis.export.csv_files import small_tables
from analysis.export.delimited import header_line, lines, write_table
from analysis.export.field import Field, Kind
from analysis.export.file_labels import file_label, renamed_text
from analysis.export.readme import write_about
from analysis.export.registry import Tell

DESCRIPTION_FILE = "dataset_description.json"
SPECIFICATION = "1.4.0"

_TYPES: dict[Kind, str] = {
    "string": "string",
    "integer": "integer",
    "number": "number",
    "boolean": "boolean",
}

_HOW = """\
A Psych-DS dataset. `dataset_description.json` lists every variable. The files in `data/` say in
their names what they hold: `study-NAME_description-laps_data.csv` is the table of laps,
`data/steps/subject-P0001_trial-1_description-steps_data.csv` the steps of one lap.
"""


def write(content: Content, folder: Path, tell: Tell) -> None:
    """Write a dataset into an empty folder."""
    data = folder / "data"
    (data / "steps").mkdir(parents=True)
    for table in small_tables(content):
        name = f"study-{file_label(content.name)}_description-{table.name}_data.csv"
        write_table(data / name, table.rows)
    header = header_line([field.name for field in content.step_fields])
    for lap, steps in content.laps_with_steps():
        tell(f"Steps of {lap['participant']}, lap {lap['lap']}")
        subject = content.labels[str(lap["participant"])]
        name = f"subject-{subject}_trial-{lap['lap']}_description-steps_data.csv"
        (data / "steps" / name).write_bytes(header + lines(steps))
    if not any((data / "steps").iterdir()):
        (data / "steps").rmdir()
    (folder / DESCRIPTION_FILE).write_text(description_text(content), encoding="utf-8")
    write_about(content, folder, _HOW + renamed_text(content.labels))


def description_text(content: Content) -> str:
    """Return the text of ``dataset_description.json``."""
    protocol = content.study.protocol
    fields = {f.name: f for t in small_tables(content) for f in t.fields}
    fields |= {f.name: f for f in content.step_fields if f.name not in fields}
    description = {
        "@context": "https://schema.org/",
        "@type": "Dataset",
        "name": content.name,
        "description": protocol.description or protocol.title,
        "schemaVersion": f"Psych-DS {SPECIFICATION}",
        "license": content.licence.url or "LICENSE",
        "variableMeasured": [_variable(field) for field in fields.values()],
    }
    return json.dumps(description, indent=1, ensure_ascii=False) + "\n"


def _variable(field: Field) -> dict[str, Any]:
    variable: dict[str, Any] = {
        "@type": "PropertyValue",
        "name": field.name,
        "description": field.description,
        "valueType": _TYPES[field.kind],
    }
    if field.unit:
        variable["unitText"] = field.unit
    if field.values:
        variable["levels"] = list(field.values)
    if field.minimum is not None:
        variable["minValue"] = field.minimum
    if field.maximum is not None:
        variable["maxValue"] = field.maximum
    return variable
