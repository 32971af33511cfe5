"""Which models help in a study, and where they come from."""

from collections.abc import Mapping
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from lad.hyperparameters import LADParameters
from protocols.cohort import Options
from protocols.files.file_model import FileModel, part_name
from protocols.shipped_parts import LAD, MODELS, WITH_PARAMETERS


class ModelChoice(FileModel):
    """The assistant that learns; Table I of the paper is the default.

    ``lad`` learns the demonstrator's command, as the paper's model does, ``lad-correction`` how it
    differs from the user's, ``lad-level`` also the share of the command that it is given; all three
    take ``parameters``. Any other model takes ``options``.

    Attributes
    ----------
    use
        A shipped model, an installed package's, or ``module:factory`` beside the protocol file.
    parameters
        Of ``lad``, ``lad-correction`` and ``lad-level``.
    options
        Settings of any other model, by name; the model checks them. In text, ``{participant}``
        stands for the participant's id and ``{folder}`` for the protocol file's folder.
    """

    use: part_name(*MODELS) = LAD  # type: ignore[valid-type]
    parameters: LADParameters = LADParameters()
    options: Options = Field(default_factory=dict)

    @model_validator(mode="after")
    def _options_are_for_others(self) -> Self:
        if self.use in WITH_PARAMETERS and self.options:
            raise ValueError(f"options are for other models; {self.use} takes parameters")
        return self


Sha256 = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


FROM_OUTSIDE = ("file", "pooled", "own laps")
"""Sources that are not in the study itself: a file, or another study's folder."""


class BorrowedModel(FileModel):
    """A model that somebody else than the participant has taught.

    Attributes
    ----------
    source
        ``from`` in a file. ``pilot``: a synthetic person who is no participant drives the study's
        training laps once. ``previous participant``: as the participant before left it (the first
        one gets the pilot's); sessions then run one after the other. ``file``: a model file.
        ``pooled``: taught all training laps of another study, one after the other. ``own laps``:
        the protocol's model, taught the training laps that the same participant had in another
        study.
    path
        Of the model file, or the study's folder. In a file's path ``{participant}`` stands for the
        participant's id: ``runs/a/sessions/{participant}/model.npz`` borrows each participant's of
        another study.
    sha256
        Of the file, or the digest of the study; filled in when the protocol is loaded, and part of
        what the study is.
    """

    source: Annotated[
        Literal["pilot", "previous participant", "file", "pooled", "own laps"],
        Field(alias="from"),
    ]
    path: str | None = None
    sha256: Sha256 | None = None

    @model_validator(mode="after")
    def _a_path_where_one_is_needed(self) -> Self:
        if (self.source in FROM_OUTSIDE) != (self.path is not None):
            raise ValueError(f"a path is needed for from: {', '.join(FROM_OUTSIDE)}; only for them")
        return self


def borrows_from_previous(models: Mapping[str, BorrowedModel]) -> bool:
    """Tell whether a session needs the model that the participant before has left."""
    return any(model.source == "previous participant" for model in models.values())
