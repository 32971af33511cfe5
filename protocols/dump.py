"""Write a protocol, a course or an instrument as plain YAML that loads again."""

import io
from typing import Any

from pydantic import BaseModel
from ruamel.yaml import YAML

_WIDTH = 100


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
        When a value is none of these.
    """
    yaml = YAML(typ="safe", pure=True)
    yaml.default_flow_style = None
    yaml.width = _WIDTH
    yaml.sort_base_mapping_type_on_output = False
    yaml.allow_unicode = True
    stream = io.StringIO()
    yaml.dump(data, stream)
    return stream.getvalue()
