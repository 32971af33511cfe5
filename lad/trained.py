"""A model that was taught before the study, for a protocol that starts with one."""

from lad.lad_assistant import LADAssistant


def load(path: str) -> LADAssistant:
    """Return the shipped model as it was saved.

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
    return LADAssistant.load(path)
