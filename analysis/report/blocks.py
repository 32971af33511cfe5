"""The parts of a page. Everything in them is ready to be shown; nothing is computed later."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import pandas as pd
from matplotlib.figure import Figure

Formatter = Callable[[Any], str]


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A paragraph of text."""

    kind: ClassVar[str] = "paragraph"
    text: str


@dataclass(frozen=True, slots=True)
class Remarks:
    """A list of short remarks."""

    kind: ClassVar[str] = "remarks"
    items: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Caution:
    """Something a reader must not miss."""

    kind: ClassVar[str] = "caution"
    text: str


@dataclass(frozen=True, slots=True)
class Fact:
    """One answer: the question, the answer in a word or number, and how sure it is."""

    question: str
    answer: str
    detail: str


@dataclass(frozen=True, slots=True)
class Facts:
    """Answers side by side."""

    kind: ClassVar[str] = "facts"
    facts: tuple[Fact, ...]


@dataclass(frozen=True, slots=True)
class Shown:
    """A column of a table as it is printed.

    Attributes
    ----------
    header
        Its heading.
    cell
        From a row of the frame (a mapping by column name) to the cell's text.
    words
        Whether the column holds words (set to the left) or numbers (to the right).
    """

    header: str
    cell: Callable[[dict[str, Any]], str]
    words: bool = False


@dataclass(frozen=True, slots=True)
class Table:
    """A table: printed cells, and the whole frame behind them for the CSV file.

    Attributes
    ----------
    name
        File name of the CSV without its ending; unique on the page.
    caption
        What it shows, and the n.
    header, words, rows
        As printed.
    frame
        Full precision.
    folded
        Whether it starts folded away.
    """

    kind: ClassVar[str] = "table"
    name: str
    caption: str
    header: tuple[str, ...]
    words: tuple[bool, ...]
    rows: tuple[tuple[str, ...], ...]
    frame: pd.DataFrame
    folded: bool = False


def table(
    name: str,
    caption: str,
    frame: pd.DataFrame,
    columns: Sequence[Shown],
    *,
    folded: bool = False,
) -> Table:
    """Return a table of some columns of a frame."""
    return Table(
        name=name,
        caption=caption,
        header=tuple(column.header for column in columns),
        words=tuple(column.words for column in columns),
        rows=tuple(
            tuple(column.cell(row) for column in columns)
            for row in ({str(k): v for k, v in r.items()} for r in frame.to_dict("records"))
        ),
        frame=frame,
        folded=folded,
    )


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure.

    Attributes
    ----------
    name
        File name without its ending; unique on the page.
    caption
        What it shows, and the n.
    alternative
        The same in words, for a reader who cannot see the figure.
    figure
        The figure.
    """

    kind: ClassVar[str] = "picture"
    name: str
    caption: str
    alternative: str
    figure: Figure


Block = Paragraph | Remarks | Caution | Facts | Table | Picture


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the page."""

    anchor: str
    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Page:
    """The whole report."""

    title: str
    subtitle: str
    sections: tuple[Section, ...]

    @property
    def tables(self) -> tuple[Table, ...]:
        """Every table on the page."""
        return tuple(b for s in self.sections for b in s.blocks if isinstance(b, Table))

    @property
    def pictures(self) -> tuple[Picture, ...]:
        """Every figure on the page."""
        return tuple(b for s in self.sections for b in s.blocks if isinstance(b, Picture))
