"""A Frictionless data package: CSV files and one description, ``datapackage.json``.

Specification: https://specs.frictionlessdata.io/data-package/ (version 1), which current tools
read. Check a copy with ``frictionless validate datapackage.json``.
"""

import json
from pathlib import Path
from typing import Any

from analysis.export.content import Content
from analysis.export.csv_files import CsvFile, write_csv_files
from analysis.export.field import Field
from analysis.export.readme import write_about
from analysis.export.registry import Tell

PACKAGE_FILE = "datapackage.json"

HOW_TO_READ = """\
A Frictionless data package. `datapackage.json` says what every column is, in which unit and range.

```
pip install frictionless
frictionless validate datapackage.json
```

In Python: `pandas.read_csv("steps.csv.gz", dtype={"participant": str})`. `h` and `h_would` have
gaps: read them as `Int8`. A pandas before version 3 keeps every digit with
`float_precision="round_trip"` only.
"""

_REFERENCES = {
    "laps": (("participant",), "participants"),
    "surveys": (("participant",), "participants"),  # an answer may be about the whole session
    "steps": (("participant", "lap"), "laps"),
}


def write(content: Content, folder: Path, tell: Tell) -> None:
    """Write a data package into an empty folder."""
    write_package(content, folder, tell, HOW_TO_READ)


def write_package(content: Content, folder: Path, tell: Tell, how_to_read: str) -> None:
    """Write a data package with what its README says about reading it."""
    files = write_csv_files(content, folder, tell)
    (folder / PACKAGE_FILE).write_text(package_text(content, files), encoding="utf-8")
    write_about(content, folder, how_to_read)


def package_text(content: Content, files: tuple[CsvFile, ...]) -> str:
    """Return the text of ``datapackage.json``."""
    licence = content.licence
    entry = {"name": licence.name, "title": licence.title}
    package = {
        "profile": "tabular-data-package",
        "name": content.name,
        "title": content.study.protocol.title,
        "description": content.study.protocol.description,
        "licenses": [entry | ({"path": licence.url} if licence.url else {"path": "LICENSE"})],
        "resources": [_resource(file, {f.name for f in files}) for file in files],
    }
    return json.dumps(package, indent=1, ensure_ascii=False) + "\n"


def _resource(file: CsvFile, there: set[str]) -> dict[str, Any]:
    schema: dict[str, Any] = {
        "fields": [_field(field) for field in file.fields],
        "primaryKey": list(file.key),
        "missingValues": [""],
    }
    names, target = _REFERENCES.get(file.name, ((), ""))
    if target in there:
        reference = {"resource": target, "fields": list(names)}
        schema["foreignKeys"] = [{"fields": list(names), "reference": reference}]
    resource: dict[str, Any] = {
        "profile": "tabular-data-resource",
        "name": file.name,
        "path": file.path,
        "description": file.description,
        "format": "csv",
        "mediatype": "text/csv",
        "encoding": "utf-8",
        "schema": schema,
    }
    return resource | ({"compression": "gz"} if file.path.endswith(".gz") else {})


def _field(field: Field) -> dict[str, Any]:
    limits: dict[str, Any] = {}
    if not field.nullable:
        limits["required"] = True
    if field.values:
        limits["enum"] = list(field.values)
    lowest = field.minimum if field.minimum is not None else field.above
    # Version 1 of the specification has no open limit: what must be above 0 may be 0 here.
    for name, value in (("minimum", lowest), ("maximum", field.maximum)):
        if value is not None:
            limits[name] = int(value) if field.kind == "integer" else value
    described: dict[str, Any] = {"name": field.name, "type": field.kind}
    if field.unit:
        described["unit"] = field.unit
    return described | {"description": field.description, "constraints": limits}
