"""The parts of a page. Everything in them is ready to be shown; nothing is computed later."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import pandas as pd
from matplotlib.figure import Figure

from analysis.figures.missing_letters import figure_scripts

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
class Spot:
    """A place in a figure that leads somewhere.

    Attributes
    ----------
    x, y
        Where, in the units of the figure's first axes.
    target
        Where it leads, from the page's folder.
    title
        What is there, in words.
    """

    x: float
    y: float
    target: str
    title: str


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
    spots
        Places in it that lead somewhere.
    """

    kind: ClassVar[str] = "picture"
    name: str
    caption: str
    alternative: str
    figure: Figure
    spots: tuple[Spot, ...] = ()

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the figure, points."""
        width, height = self.figure.get_size_inches()
        return float(72 * width), float(72 * height)

    @property
    def scripts(self) -> tuple[str, ...]:
        """Scripts in the figure that its own font lacks letters of."""
        return figure_scripts(self.figure)

    @property
    def wide(self) -> bool:
        """Whether the figure needs the page's whole width for its letters to be read."""
        return self.size[0] > 550


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
