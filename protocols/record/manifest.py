"""The checksums of a session's files, and the software that made them."""

import hashlib
import json
from collections.abc import Mapping
from typing import Annotated

from pydantic import Field, ValidationError

from protocols.files.file_model import FileModel
from protocols.record.column import SCHEMA_VERSION, SchemaVersion
from protocols.versions import package_versions

MANIFEST_FILE = "manifest.json"


class FileEntry(FileModel):
    """Size in bytes and SHA-256 of one file."""

    bytes: Annotated[int, Field(ge=0)]
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


class Manifest(FileModel):
    """What a session folder holds.

    Attributes
    ----------
    files
        Every file but the manifest itself, by name.
    versions
        Of the packages that made them.
    study
        Digest of the study it belongs to, as in ``study.yaml``; None when it is not given.
    """

    schema_version: Annotated[SchemaVersion, Field(alias="schema")] = SCHEMA_VERSION
    study: str | None = None
    files: dict[str, FileEntry]
    versions: dict[str, str]


def manifest_of(files: Mapping[str, bytes], study: str | None = None) -> bytes:
    """Return the manifest of these files, as written, in a session of this study."""
    entries = {name: entry(files[name]) for name in sorted(files)}
    manifest = Manifest(study=study, files=entries, versions=package_versions())
    text = json.dumps(manifest.model_dump(mode="json", by_alias=True), indent=1)
    return f"{text}\n".encode()


def entry(content: bytes) -> FileEntry:
    """Return a file's size and checksum."""
    return FileEntry(bytes=len(content), sha256=hashlib.sha256(content).hexdigest())


def parse_manifest(content: bytes) -> Manifest | None:
    """Return the manifest; None when the content is not one."""
    try:
        return Manifest.model_validate_json(content)
    except ValidationError:
        return None
