"""The page in short, as Markdown: every row, and the figures as files."""

from collections.abc import Iterable, Sequence

from analysis.report.blocks import Page
from analysis.reproduction.page import by_section
from analysis.reproduction.printed import VERDICT_TEXT, interval_of, number_of, tolerance_of
from analysis.reproduction.row import Row

_HEAD = ("quantity", "unit", "paper", "ours", "n", "interval", "tolerance", "kind", "verdict")


def markdown(page: Page, rows: Sequence[Row]) -> str:
    """Return every row as a table line, grouped by section, and the page's figures."""
    parts = [f"# {page.title}", page.subtitle]
    for section, part in by_section(rows):
        parts += [f"## {section}", row_table(part)]
    parts.append("## Figures")
    parts += [f"![{p.alternative}](figures/{p.name}.png)\n\n{p.caption}" for p in page.pictures]
    return "\n\n".join(parts) + "\n"


def row_table(rows: Iterable[Row]) -> str:
    """Return rows as a Markdown table."""
    lines = [_HEAD, tuple("---" for _ in _HEAD), *map(_cells, rows)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _cells(row: Row) -> tuple[str, ...]:
    return (
        row.quantity,
        row.unit or "1",
        number_of(row, row.paper),
        number_of(row, row.ours),
        str(row.n),
        interval_of(row),
        tolerance_of(row),
        row.kind,
        VERDICT_TEXT[row.verdict],
    )
