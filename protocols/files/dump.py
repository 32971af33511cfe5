"""Write a protocol, a course or an instrument as plain YAML that loads again."""

import io
from typing import Any

from pydantic import BaseModel
from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.representer import RoundTripRepresenter
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

_WIDTH = 1_000_000  # a folded line would end in a space


class _Representer(RoundTripRepresenter):
    """Writes a missing value as ``null``, not as nothing."""


_Representer.add_representer(
    type(None), lambda self, _: self.represent_scalar("tag:yaml.org,2002:null", "null")
)


def to_yaml(model: BaseModel) -> str:
    """Return a file's text: every field, defaults included, in the order of the format.

    Parameters
    ----------
    model
        A ``StudyProtocol``, ``Course`` or ``Instrument``.
    """
    return plain_yaml(model.model_dump(mode="json", by_alias=True))


def plain_yaml(data: Any) -> str:
    """Return mappings, lists, text and numbers as YAML 1.2.

    Raises
    ------
    TypeError
        When a value is of another type.
    """
    yaml = YAML(typ="rt", pure=True)
    yaml.Representer = _Representer
    yaml.width = _WIDTH
    yaml.allow_unicode = True
    yaml.indent(mapping=2, sequence=4, offset=2)
    text = io.StringIO()
    yaml.dump(_styled(data), text)
    return text.getvalue()


def _styled(data: Any) -> Any:
    """Put mappings on lines of their own and lists of plain values on one."""
    if isinstance(data, dict):
        return CommentedMap((_styled(key), _styled(value)) for key, value in data.items())
    if isinstance(data, list):
        items = CommentedSeq(_styled(value) for value in data)
        if not any(isinstance(value, dict | list) for value in data):
            items.fa.set_flow_style()
        return items
    if isinstance(data, str) and not data.isprintable():
        return DoubleQuotedScalarString(data)  # line breaks of every kind survive in this style
    return data
