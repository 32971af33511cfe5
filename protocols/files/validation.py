"""Check a file's data against a model, and name each fault with the words of the file."""

import json
from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from protocols.files.document import Document
from protocols.files.fault import Fault, InconsistentError, Location
from protocols.files.wording import worded

Model = TypeVar("Model", bound=BaseModel)

MOST_FAULTS = 200
"""Faults that are looked at: one is shown, and how many there are besides."""


def validate(document: Document, model: type[Model]) -> Model:
    """Return the document's data as a model.

    Numbers must be numbers and text must be text: nothing is converted silently.

    Raises
    ------
    InputError
        One line per fault: file, line, field, what was given and what is allowed.
    """
    # JSON is the mode in which pydantic is strict about scalars and takes a list for a tuple.
    try:
        return model.model_validate_json(json.dumps(document.data), strict=True)
    except ValidationError as error:
        found = error.errors(include_url=False)[:MOST_FAULTS]
        items = [item for item in found if not _misspelt(item, found)]
        faults = [f for item in items for f in _faults(item, document.data, model)]
        raise document.error(_worth_telling(faults)) from None


def _misspelt(item: Any, items: Iterable[Any]) -> bool:
    """Return whether a missing field is there under a similar name; one fault is enough then."""
    parent, name = item["loc"][:-1], item["loc"][-1:]
    return item["type"] == "missing" and any(
        get_close_matches(str(other["loc"][-1]), [str(*name)])
        for other in items
        if other["type"] == "extra_forbidden" and other["loc"][:-1] == parent
    )


def _faults(item: Any, data: Any, model: type[BaseModel]) -> list[Fault]:
    where = _in_the_file(item["loc"], data, item["type"])
    cause = item.get("ctx", {}).get("error")
    if isinstance(cause, InconsistentError):
        return [Fault((*where, *fault.where), fault.message) for fault in cause.faults]
    return [Fault(where, worded(item, where, model))]


def _in_the_file(loc: Location, data: Any, kind: str) -> Location:
    """Drop what pydantic put into a location that is not in the file (names of alternatives)."""
    where: Location = ()
    for i, part in enumerate(loc):
        inside = (isinstance(data, dict) and part in data) or (
            isinstance(data, list) and isinstance(part, int) and part < len(data)
        )
        if inside:
            data = data[part]
        elif not (kind == "missing" and i == len(loc) - 1):
            continue
        where = (*where, part)
    return where


def _worth_telling(faults: Iterable[Fault]) -> list[Fault]:
    """Join the alternatives of one place; drop a fault that a fault inside it explains."""
    messages: dict[Location, list[str]] = {}
    for fault in faults:
        known = messages.setdefault(fault.where, [])
        if fault.message not in known:
            known.append(fault.message)
    return [
        Fault(where, "; or ".join(known))
        for where, known in messages.items()
        if not any(other != where and other[: len(where)] == where for other in messages)
    ]
