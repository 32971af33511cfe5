"""What every part of a protocol or instrument file has in common."""

import re
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema

Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9 _.-]*$", max_length=80)]
"""A short name: letters, digits, space, ``_``, ``.``, ``-``; it begins with a letter or digit."""

MAX_PART_NAME = 200
"""Characters that the name of a part may have."""

_PART = r"[A-Za-z_][A-Za-z0-9_.-]*(:[A-Za-z_][A-Za-z0-9_]*)?"


def _no_truth_value(value: Any) -> Any:
    """Refuse true and 1.0, which Python holds to be equal to 1."""
    if type(value) is int or not isinstance(value, int | float):
        return value
    raise ValueError(f"must be a whole number; given {str(value).lower()}")


FormatVersion = BeforeValidator(_no_truth_value)
"""Of a field with the version of a file's format: only a whole number."""


class FileModel(BaseModel):
    """A frozen part of a file: unknown fields, NaN and infinity are refused."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, validate_default=True
    )


def part_name(*shipped: str) -> Any:
    """Return the type of a field that names a part of a study.

    Parameters
    ----------
    shipped
        Names of the parts that come with the package.

    Returns
    -------
    Any
        Text that is one of ``shipped``, the name of an installed package's part, or of the form
        ``module:factory``. Whether there is such a part is found out where the file's folder is
        known (``protocols.parts``): a recorded study is read where its parts are not installed.
    """
    hint = f"{', '.join(shipped)}, another name of letters, digits, _, ., -, or module:factory"

    def check(value: str) -> str:
        if len(value) <= MAX_PART_NAME and re.fullmatch(_PART, value):
            return value
        given = repr(value) if len(value) <= MAX_PART_NAME else f"text of {len(value)} characters"
        raise ValueError(f"{given} names no part; allowed: {hint}")

    schema = {"anyOf": [{"enum": list(shipped)}, {"type": "string", "pattern": f"^{_PART}$"}]}
    return Annotated[str, AfterValidator(check), WithJsonSchema({**schema, "type": "string"})]
