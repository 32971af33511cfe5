"""An RO-Crate: a Frictionless data package with research metadata around it.

Specification: https://w3id.org/ro/crate/1.2. Check a copy with ``rocrate-validator validate``.
"""

import hashlib
import json
from pathlib import Path
from typing import Any

from analysis.export.content import Content
from analysis.export.formats import frictionless
from analysis.export.registry import Tell
from protocols.versions import package_versions

METADATA_FILE = "ro-crate-metadata.json"
SPECIFICATION = "https://w3id.org/ro/crate/1.2"

PUBLISHED = "1970-01-01"
"""A crate must have a date, and the record has none: the README says to put it in."""

_HOW = f"""\
An RO-Crate 1.2 around a Frictionless data package. `{METADATA_FILE}` names every file with its
checksum. **`datePublished` is a placeholder ({PUBLISHED}): put in the day of publication, and who
the authors are.**

```
pip install roc-validator
rocrate-validator validate .
```

"""

_MEDIA = {
    ".csv": "text/csv",
    ".gz": "application/gzip",
    ".json": "application/json",
    ".md": "text/markdown",
    ".yaml": "application/yaml",
}
_ABOUT = {
    "participants.csv": "One row per participant",
    "laps.csv": "One row per lap begun",
    "surveys.csv": "One row per question asked",
    "items.csv": "The questions",
    "steps.csv.gz": "One row per control step",
    "datapackage.json": "Every column's description, unit and limits (Frictionless)",
    "study.yaml": "Protocol, course and questionnaires",
    "README.md": "What this is, and what was left out",
    "LICENSE": "The licence",
}


def write(content: Content, folder: Path, tell: Tell) -> None:
    """Write a crate into an empty folder."""
    frictionless.write_package(content, folder, tell, _HOW + frictionless.HOW_TO_READ)
    tell("Checksums")
    (folder / METADATA_FILE).write_text(metadata_text(content, folder), encoding="utf-8")


def metadata_text(content: Content, folder: Path) -> str:
    """Return the text of ``ro-crate-metadata.json`` for the files in a folder."""
    files = sorted(path for path in folder.iterdir() if path.name != METADATA_FILE)
    graph = [
        {
            "@id": METADATA_FILE,
            "@type": "CreativeWork",
            "about": {"@id": "./"},
            "conformsTo": {"@id": SPECIFICATION},
        },
        _root(content, [path.name for path in files]),
        *_licence(content),
        *map(_file, files),
        *_software(),
    ]
    crate = {"@context": f"{SPECIFICATION}/context", "@graph": graph}
    return json.dumps(crate, indent=1, ensure_ascii=False) + "\n"


def _root(content: Content, names: list[str]) -> dict[str, Any]:
    protocol = content.study.protocol
    return {
        "@id": "./",
        "@type": "Dataset",
        "name": protocol.title,
        "description": protocol.description or protocol.title,
        "datePublished": PUBLISHED,
        "license": {"@id": content.licence.url or "LICENSE"},
        "hasPart": [{"@id": name} for name in names],
        "mentions": {"@id": "#export"},
    }


def _licence(content: Content) -> list[dict[str, Any]]:
    licence = content.licence
    if not licence.url:
        return []
    entry = {"@id": licence.url, "@type": "CreativeWork", "name": licence.title}
    return [entry | {"description": f"SPDX identifier {licence.name}"}]


def _file(path: Path) -> dict[str, Any]:
    with path.open("rb") as stream:
        checksum = hashlib.file_digest(stream, "sha256").hexdigest()
    return {
        "@id": path.name,
        "@type": "File",
        "name": path.name,
        "description": _ABOUT.get(path.name, path.name),
        "contentSize": str(path.stat().st_size),
        "encodingFormat": _MEDIA.get(path.suffix, "text/plain"),
        "sha256": checksum,
    }


def _software() -> list[dict[str, Any]]:
    version = package_versions(("lad-study",)).get("lad-study", "unknown")
    export = {
        "@id": "#export",
        "@type": "CreateAction",
        "name": "Export of the study",
        "instrument": {"@id": "#lad-study"},
        "result": {"@id": "./"},
    }
    software = {
        "@id": "#lad-study",
        "@type": "SoftwareApplication",
        "name": "lad-study",
        "version": version,
        "softwareVersion": version,
        "url": "https://pypi.org/project/lad-study/",
    }
    return [export, software]
