"""A model that was taught before the study, for a protocol that starts with one."""

from lad.correction import CorrectionAssistant
from lad.lad_assistant import LADAssistant
from lad.level import LevelAssistant
from lad.model_file import kind_of, read

KINDS: dict[str, type[LADAssistant]] = {
    cls.kind: cls for cls in (LADAssistant, CorrectionAssistant, LevelAssistant)
}
"""Shipped assistants by what their files say that they are."""


def load(path: str) -> LADAssistant:
    """Return a shipped model as it was saved, of whichever kind.

    A protocol names it ``taught``, and the file by participant:
    ``{use: taught, options: {path: "{folder}/sessions/{participant}/model.npz"}}``.

    Parameters
    ----------
    path
        Of a file that ``LADAssistant.save`` or a study has written.

    Raises
    ------
    ModelFileError
        When it cannot be read or is not such a model; names the path.
    """
    return from_bytes(read(path), path)


def from_bytes(data: bytes, source: str = "model") -> LADAssistant:
    """Return a shipped model from the bytes of its file, of whichever kind.

    Raises
    ------
    ModelFileError
        When it is none; names the source.
    """
    return KINDS.get(kind_of(data, source), LADAssistant).from_bytes(data, source)
