"""What every part of a protocol or instrument file has in common."""

import re
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, WithJsonSchema

Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9 _.-]*$", max_length=80)]
"""A short name: letters, digits, space, ``_``, ``.``, ``-``; it begins with a letter or digit."""

_FACTORY = r"^[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*$"


class FileModel(BaseModel):
    """A frozen part of a file: unknown fields, NaN and infinity are refused."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, validate_default=True
    )


def shipped_or_factory(*shipped: str) -> Any:
    """Return the type of a field that names a shipped component or somebody else's factory.

    Parameters
    ----------
    shipped
        Names of the components that come with the package.

    Returns
    -------
    Any
        Text that is one of ``shipped`` or of the form ``package.module:factory``. Whether the
        factory can be imported is found out where it is called.
    """
    allowed = f"{', '.join(shipped)}, or package.module:factory"

    def check(value: str) -> str:
        if value in shipped or re.match(_FACTORY, value):
            return value
        raise ValueError(f"'{value}' is not known here; allowed: {allowed}")

    schema = {"anyOf": [{"enum": list(shipped)}, {"type": "string", "pattern": _FACTORY}]}
    return Annotated[str, AfterValidator(check), WithJsonSchema({**schema, "type": "string"})]
