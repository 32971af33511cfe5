"""The table that is printed after a reproduction of the paper."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich import box
from rich.table import Table

from harness.cli.console import print_table

if TYPE_CHECKING:
    from analysis.reproduction.row import Row


def print_rows(rows: "Sequence[Row]") -> None:
    """Print what the paper prints too, or what has a verdict: both numbers and the verdict."""
    from analysis.reproduction.printed import VERDICT_TEXT, number_of

    table = Table(box=box.SIMPLE_HEAD, title="The paper and ours", title_justify="left")
    table.add_column("quantity", no_wrap=True)
    for heading in ("unit", "paper", "ours", "n", "verdict"):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in rows:
        if row.paper is None and row.tolerance is None:
            continue
        table.add_row(
            row.quantity,
            row.unit,
            number_of(row, row.paper),
            number_of(row, row.ours),
            str(row.n),
            VERDICT_TEXT[row.verdict],
        )
    print_table(table)
