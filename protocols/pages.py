"""Pages of a session as a protocol file has them: consent, particulars, debriefing."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from protocols.files.file_model import FileModel

Particular = Literal["age_years", "gender", "handedness"]
"""What a participant can be asked about their own person."""


class Text(FileModel):
    """A page's text (Markdown): written here, or in a file; exactly one of the two.

    Attributes
    ----------
    file
        Path relative to the protocol file. A study directory has the text in its place.
    text
        The text itself.
    """

    file: Annotated[str, Field(min_length=1)] | None = None
    text: Annotated[str, Field(min_length=1)] | None = None

    @model_validator(mode="after")
    def _one_of_them(self) -> Self:
        if (self.file is None) == (self.text is None):
            raise ValueError("give either file or text")
        return self


class Consent(Text):
    """What a participant agrees to, and its version: the record says which one it was.

    Attributes
    ----------
    version
        Of the text.
    sharing
        Whether the text says that the data may be given to others; without it
        ``lad-study export`` refuses living people's data.
    """

    version: Annotated[str, Field(min_length=1, max_length=80)]
    sharing: bool = False
