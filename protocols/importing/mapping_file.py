"""Mapping files: what is where in somebody else's file."""

from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel

from protocols.files.document import MAX_BYTES, Document, parse
from protocols.files.errors import InputError
from protocols.files.validation import validate

Model = TypeVar("Model", bound=BaseModel)


def read_mapping(path: Path, model: type[Model]) -> tuple[Model, Document]:
    """Return a mapping file's content, and the document that knows its lines.

    Raises
    ------
    InputError
        When it cannot be read, or a field is wrong; names line, field and what is allowed.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    document = parse(content, str(path))
    return validate(document, model), document
