"""Pages of a session beside driving and questionnaires, and the seam of who reads them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, Protocol

from participants.survey import Answer

PageKind = Literal["consent", "demographics", "break", "debrief"]

AGREED = "agreed"
"""Under this name a consent page's answer is kept: 1 or 0."""


@dataclass(frozen=True, slots=True)
class Page:
    """A page as it is shown.

    Attributes
    ----------
    kind
        What it is for.
    text
        Its words.
    fields
        What is asked for on it, by name.
    seconds
        How long a break lasts at least, s; 0 for other pages.
    """

    kind: PageKind
    text: str = ""
    fields: tuple[str, ...] = ()
    seconds: float = 0.0


class PageReader(Protocol):
    """Reads pages, and enters what they ask for."""

    def read(self, page: Page) -> Mapping[str, Answer]:
        """Return what was entered, by field; None for a field that was left out.

        A consent page is answered with ``AGREED``: 1 or 0.

        Raises
        ------
        WithdrewError
            When the participant wants to stop.
        """


class SimulatedReader:
    """A synthetic participant: agrees, and fills in its particulars.

    Parameters
    ----------
    particulars
        By field.
    """

    def __init__(self, particulars: Mapping[str, int | str]) -> None:
        self._particulars = particulars

    def read(self, page: Page) -> Mapping[str, Answer]:
        """Return what was entered, by field."""
        if page.kind == "consent":
            return {AGREED: 1}
        return {name: self._particulars.get(name) for name in page.fields}
