"""The page: the answer, every row, and the figures."""

from collections.abc import Iterable, Sequence

import pandas as pd

from analysis.report.blocks import (
    Block,
    Caution,
    Fact,
    Facts,
    Page,
    Section,
    Shown,
    Table,
    table,
)
from analysis.report.numbers import NOTHING, plural
from analysis.reproduction.evidence import Evidence
from analysis.reproduction.printed import VERDICT_TEXT, interval_of, number_of, tolerance_of
from analysis.reproduction.row import Kind, Row
from analysis.reproduction.sections.accuracy import accuracy_section
from analysis.reproduction.sections.driver import driver_section
from analysis.reproduction.sections.people import people_section
from analysis.reproduction.sections.reading import reading_section


def build_page(evidence: Evidence, rows: Sequence[Row], further: Sequence[Section]) -> Page:
    """Return the page.

    Parameters
    ----------
    evidence
        The data of the rows and figures.
    rows
        Every quantity.
    further
        Sections that follow the paper's own experiments.
    """
    return Page(
        title="When and How to Help, reproduced",
        subtitle="The experiments of Soh & Demiris (2013), simulated with synthetic participants; "
        f"seed {evidence.seed}",
        sections=(
            _answer(rows),
            driver_section(evidence),
            accuracy_section(evidence),
            people_section(evidence),
            *further,
            reading_section(),
        ),
    )


def _answer(rows: Sequence[Row]) -> Section:
    blocks: list[Block] = [Facts((_fact(rows, "calibrated"), _fact(rows, "predicted")))]
    differing = [row for row in rows if row.verdict == "differs"]
    if differing:
        blocks.append(Caution(f"What differs: {'; '.join(map(_in_words, differing))}."))
    blocks += [_table(section, part) for section, part in by_section(rows)]
    return Section("answer", "The paper's numbers and ours", tuple(blocks))


def by_section(rows: Iterable[Row]) -> list[tuple[str, list[Row]]]:
    """Return the rows of each section, sections in the order of their first row."""
    parts: dict[str, list[Row]] = {}
    for row in rows:
        parts.setdefault(row.section, []).append(row)
    return list(parts.items())


def _fact(rows: Sequence[Row], kind: Kind) -> Fact:
    judged = [row for row in rows if row.kind == kind and row.verdict != "none"]
    holding = sum(row.verdict == "holds" for row in judged)
    detail = {
        "calibrated": "Fitted to the paper's figures with other random numbers.",
        "predicted": "Not fitted to anything: they could have been different.",
        "descriptive": "",
    }[kind]
    return Fact(f"{kind.capitalize()} figures within their tolerance",
                f"{holding} of {len(judged)}", detail)  # fmt: skip


def _in_words(row: Row) -> str:
    paper = "" if row.paper is None else f", paper {number_of(row, row.paper)}"
    unit = f" {row.unit}" if row.unit else ""
    return (
        f"{row.quantity}: {number_of(row, row.ours)}{unit} ({interval_of(row)}){paper}, "
        f"tolerance {tolerance_of(row)}"
    )


def _table(section: str, rows: Sequence[Row]) -> Table:
    name = "".join(c if c.isalnum() else "_" for c in section.lower()).strip("_")
    frame = pd.DataFrame([row.as_json() for row in rows])
    known = {row.quantity: row for row in rows}
    columns = [
        Shown("quantity", lambda r: r["quantity"], words=True),
        Shown("unit", lambda r: r["unit"] or "1", words=True),
        Shown("paper", lambda r: number_of(known[r["quantity"]], known[r["quantity"]].paper)),
        Shown("ours", lambda r: number_of(known[r["quantity"]], known[r["quantity"]].ours)),
        Shown("n", lambda r: str(r["n"])),
        Shown("interval", lambda r: interval_of(known[r["quantity"]])),
        Shown("tolerance", lambda r: tolerance_of(known[r["quantity"]])),
        Shown("kind", lambda r: r["kind"], words=True),
        Shown("verdict", lambda r: VERDICT_TEXT[r["verdict"]] or NOTHING, words=True),
    ]
    caption = f"{section}. {plural(len(rows), 'quantity', 'quantities')}."
    beside_the_paper = any(row.paper is not None or row.tolerance is not None for row in rows)
    return table(f"rows_{name}", caption, frame, columns, folded=not beside_the_paper)
