"""Options of drivers and demonstrators, as a protocol file gives them."""

from collections.abc import Mapping
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from protocols.files.errors import InputError
from protocols.files.wording import shown


class Options(BaseModel):
    """Options of a component; a subclass names each option, its type and its range."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class NoOptions(Options):
    """Options of a component that has none."""


Given = TypeVar("Given", bound=Options)


def read_options(who: str, kind: type[Given], given: Mapping[str, Any]) -> Given:
    """Return checked options.

    Parameters
    ----------
    who
        The component whose options they are, for the message, e.g. ``"driver 'human'"``.
    kind
        What is allowed.
    given
        What the protocol gives.

    Raises
    ------
    InputError
        In one line for each fault, what was given and what is allowed.
    """
    try:
        return kind.model_validate(dict(given))
    except ValidationError as error:
        raise InputError(*(_fault(who, kind, item) for item in error.errors())) from None


def _fault(who: str, kind: type[Options], item: Any) -> str:
    where = ".".join(str(part) for part in item["loc"])
    if item["type"] == "extra_forbidden" and len(item["loc"]) == 1:
        allowed = ", ".join(kind.model_fields) or "it takes no options"
        return f"{who}: option {where!r} does not exist; allowed: {allowed}"
    message = item["msg"].removeprefix("Value error, ")
    if not where:
        return f"{who}: {message}"
    return f"{who}: option {where!r}: {message} (given {shown(item['input'])})"
