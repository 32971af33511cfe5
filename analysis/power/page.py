"""The page on power: a table, a figure, and a paragraph to paste."""

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from analysis.attainable import least_n
from analysis.figures.style import GREY, new_figure, tidy
from analysis.power.pool import planned_practice
from analysis.power.power import STUDIES, PowerRow, smallest_n
from analysis.report.blocks import (
    Block,
    Caution,
    Page,
    Paragraph,
    Picture,
    Remarks,
    Section,
    Shown,
    table,
)
from analysis.report.numbers import NOTHING, count, number, percent, plural
from analysis.report.render import draw, figure_files, render
from analysis.report.write import replace_folder
from protocols.declared import Comparison
from protocols.study import StudyProtocol


@dataclass(frozen=True, slots=True)
class PowerStudy:
    """What was computed, and from which people.

    Attributes
    ----------
    protocol
        The plan.
    rows
        As ``power_rows`` returns them.
    pool
        Number of people drawn from.
    simulated
        Whether they are synthetic.
    target
        The power that is wanted.
    """

    protocol: StudyProtocol
    rows: tuple[PowerRow, ...]
    pool: int
    simulated: bool
    target: float


def write_power(folder: Path, study: PowerStudy) -> Path:
    """Write ``index.html``, ``power.json``, figure and table into ``folder/power``, all or nothing.

    Raises
    ------
    OSError
        When they cannot be written; an older page is still there then.
    """
    page = power_page(study)
    drawings = {name: wait() for name, wait in draw(page).items()}
    contents: dict[str, bytes] = {
        "index.html": render(page, drawings).encode(),
        "power.json": power_json(study.rows).encode(),
        **figure_files(drawings),
        **{f"{t.name}.csv": t.frame.to_csv(index=False).encode() for t in page.tables},
    }
    replace_folder(folder / "power", contents)
    return folder / "power" / "index.html"


def power_json(rows: Sequence[PowerRow]) -> str:
    """Return rows of analysis, n, power, mc_error, pool_error and source, as JSON."""
    names = ("analysis", "n", "power", "mc_error", "pool_error", "source")
    return json.dumps([{name: getattr(r, name) for name in names} for r in rows], indent=1) + "\n"


def power_page(study: PowerStudy) -> Page:
    """Return the page."""
    blocks: list[Block] = [
        Paragraph(_what_it_means(study)),
        *(Caution(text) for text in _without_verdict(study)),
        Picture("power", _CAPTION.format(target=percent(100 * study.target)), _said(study),
                _figure(study)),
        table("power", "Power of each declared analysis.", _frame(study), _COLUMNS),
        Remarks(tuple(_needed(study, a) for a in study.protocol.analyses)),
        Paragraph(_to_paste(study)),
    ]  # fmt: skip
    title = f"Power: {study.protocol.title}"
    people = "synthetic people" if study.simulated else "people"
    subtitle = f"{study.protocol.name}, drawn from a pool of {study.pool} {people}"
    return Page(title, subtitle, (Section("power", "How many participants?", tuple(blocks)),))


_CAPTION = (
    "Power against the number of participants, at 5%, after Holm where an analysis is "
    "confirmatory. Bars: one standard error, of the drawing and of the pool together. Dotted: the "
    "target, {target}."
)


def _what_it_means(study: PowerStudy) -> str:
    stated = sorted({r.analysis for r in study.rows if r.source == "stated"})
    taken = sorted({r.analysis for r in study.rows if r.source == "cohort"})
    said = ["Power is the share of studies in which the declared test is significant."]
    if stated:
        said.append(
            f"For {', '.join(stated)} the effect is stated: the pool gives only the shape of the "
            "differences, and their spread."
        )
    if taken:
        said.append(
            f"For {', '.join(taken)} the effect is the pool's own: if the pool's people are not "
            "like yours, neither is this power."
        )
    if study.simulated:
        said.append("The people are synthetic: spread and shape are assumptions of the simulation.")
    return " ".join(said)


def _without_verdict(study: PowerStudy) -> Iterator[str]:
    """Caution about analyses whose report will give no verdict, however many people there are."""
    n = max(r.n for r in study.rows)
    confounded = [
        a.name
        for a in study.protocol.analyses
        if a.outcome == "lap_time_s"
        and a.groups is None
        and planned_practice(study.protocol, a, n) == "confounded"
    ]
    if confounded:
        yield (
            "In these orders the place of a lap follows from its condition "
            f"({', '.join(confounded)}): a significant difference may be practice in part, and the "
            "report gives no verdict on the condition, whatever the power. Other orders: `orders` "
            "in the protocol."
        )


def _figure(study: PowerStudy) -> Figure:
    figure = new_figure(3.6)
    axes = figure.subplots()
    styles = ["-o", "--s", "-.^", ":D"]
    for i, analysis in enumerate(study.protocol.analyses):
        rows = [r for r in study.rows if r.analysis == analysis.name]
        error = [math.hypot(r.mc_error, r.pool_error) for r in rows]
        face = "white" if analysis.kind == "exploratory" else None
        axes.errorbar([r.n for r in rows], [r.power for r in rows], yerr=error, capsize=2,
                      fmt=styles[i % 4], markersize=4, label=analysis.name,
                      markerfacecolor=face)  # fmt: skip
    axes.axhline(study.target, color=GREY, linewidth=1, linestyle=":")
    axes.set_ylim(-0.02, 1.04)
    axes.set_xlabel("participants")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))  # no half people
    axes.set_ylabel("power")
    tidy(axes, grid="y")
    figure.legend(loc="outside upper center", ncols=2, frameon=False, fontsize=8)
    return figure


def _frame(study: PowerStudy) -> pd.DataFrame:
    return pd.DataFrame([{f: getattr(r, f) for f in PowerRow.__slots__} for r in study.rows])


_COLUMNS = [
    Shown("analysis", lambda r: r["analysis"], words=True),
    Shown("participants", lambda r: count(r["n"])),
    Shown("power", lambda r: number(r["power"], 2)),
    Shown("error, draws", lambda r: number(r["mc_error"], 3)),
    Shown("error, pool", lambda r: number(r["pool_error"], 3)),
    Shown("effect", lambda r: r["source"], words=True),
    Shown("wrong sign", lambda r: percent(100 * r["wrong_sign"], 1)),
    Shown("exaggeration", lambda r: _times(r["exaggeration"])),
    Shown("interval's width", lambda r: number(r["width"], 3)),
]


def _times(value: float) -> str:
    return NOTHING if math.isnan(value) else f"× {number(value, 2)}"


def _needed(study: PowerStudy, analysis: Comparison) -> str:
    n = smallest_n(study.rows, analysis.name, study.target)
    most = max(r.n for r in study.rows)
    target = percent(100 * study.target)
    reached = (
        f"{n} participants are the fewest computed that reach {target}"
        if n is not None
        else f"{target} is not reached with {most} participants"
    )
    return f"{analysis.name}: {reached}{impossible_below(study.protocol, analysis)}."


def impossible_below(protocol: StudyProtocol, analysis: Comparison) -> str:
    """Return the end of a sentence: with how few people an analysis cannot be significant."""
    least = least_n(protocol, analysis)
    if least is None:
        return ""
    people = "complete pair" if analysis.groups is None else "participant"
    return f"; impossible below {plural(least, people)}"


def _said(study: PowerStudy) -> str:
    last = max(r.n for r in study.rows)
    at = (f"{r.analysis} {number(r.power, 2)}" for r in study.rows if r.n == last)
    return f"Power curves. With {last} participants: {'; '.join(at)}."


def _to_paste(study: PowerStudy) -> str:
    sizes = sorted({r.n for r in study.rows})
    confirmatory = [a for a in study.protocol.analyses if a.kind == "confirmatory"]
    said = "; ".join(_size_in_words(study, a) for a in confirmatory or study.protocol.analyses)
    people = "synthetic participants of lad-study" if study.simulated else "recorded participants"
    dropout = study.protocol.cohort.expected_dropout
    leaving = f" {percent(100 * dropout)} were taken to drop out." if dropout else ""
    return (
        f"To paste: Sample size was planned by simulation. {STUDIES:,} studies for each of "
        f"{len(sizes)} sizes ({sizes[0]} to {sizes[-1]} participants) were drawn without "
        f"replacement from {study.pool} {people} and tested as declared (Wilcoxon signed-rank on "
        f"log ratios of lap times{_of_groups(study)}, Holm within the family, two-sided 5%; two "
        f"one-sided tests where a margin is declared).{leaving} {said}."
    )


def _of_groups(study: PowerStudy) -> str:
    compared = any(a.groups is not None for a in study.protocol.analyses)
    return "; rank-sum tests of people's values between groups" if compared else ""


def _size_in_words(study: PowerStudy, analysis: Comparison) -> str:
    mine = [r for r in study.rows if r.analysis == analysis.name]
    n = smallest_n(study.rows, analysis.name, study.target)
    row = next((r for r in mine if r.n == n), mine[-1])
    effect = (
        f"{number(100 * math.expm1(row.effect), 0)}% lap time"
        if analysis.outcome == "lap_time_s"
        else f"{number(row.effect, 2)} in {analysis.outcome}"
    )
    source = "assumed" if row.source == "stated" else "of the pool"
    error = float(np.hypot(row.mc_error, row.pool_error))
    return (
        f"for {analysis.name} ({effect}, {source}) {row.n} participants give a power of "
        f"{number(row.power, 2)} (standard error {number(error, 2)})"
    )
