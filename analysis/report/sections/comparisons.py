"""Tests between conditions: confirmatory and exploratory, kept apart as the protocol declares."""

from collections.abc import Sequence
from typing import Any

from analysis.comparisons import PairedComparison
from analysis.report.blocks import Block, Paragraph, Remarks, Section, Shown, table
from analysis.report.words import count, interval, number, p_value
from analysis.results import StudyResults
from analysis.tables.comparisons import comparison_table


def comparison_section(results: StudyResults) -> Section:
    """Return what was declared first, then everything that was not."""
    confirmatory = [c for c in results.declared if c.kind == "confirmatory"]
    declared = [c for c in results.declared if c.kind == "exploratory"]
    blocks: list[Block] = []
    if confirmatory:
        caption = (
            "Confirmatory comparisons, as the protocol declared them before the first lap; p after "
            "Holm's correction within each family."
        )
        blocks += _table("confirmatory", caption, confirmatory, [_NAME, *_PAIR, *_TEST, _HOLM])
    else:
        blocks.append(Paragraph("The protocol declares no confirmatory comparison."))
    if declared:
        caption = "Exploratory comparisons that the protocol declares; p not corrected."
        blocks += _table("exploratory", caption, declared, [_NAME, *_PAIR, *_TEST, _TOST])
    if results.lap_times:
        caption = (
            "Exploratory: lap times of every two conditions; p not corrected. Differences in "
            "seconds, condition minus reference. D and its p: Kolmogorov-Smirnov."
        )
        columns = [*_PAIR, *_TEST, *_KS]
        blocks += _table("lap_time_comparisons", caption, results.lap_times, columns)
        blocks.append(Paragraph(_ABOUT_KS))
    return Section("comparisons", "Comparisons", tuple(blocks))


_ABOUT_KS = (
    "Kolmogorov-Smirnov compares whole distributions and assumes two separate groups; the paper "
    "used it on laps of the autonomous driver. Here both samples come from the same people, so D "
    "and its p only describe."
)


def _table(
    name: str, caption: str, comparisons: Sequence[PairedComparison], columns: list[Shown]
) -> list[Block]:
    """Return tests and effect sizes of some comparisons, and remarks where there are any."""
    frame = comparison_table(comparisons)
    remarks = tuple(f"{r['name']}: {r['notes']}." for r in frame.to_dict("records") if r["notes"])
    found = table(name, f"{caption} In parentheses: 95% intervals.", frame, [*columns, *_EFFECTS])
    return [found, Remarks(remarks)] if remarks else [found]


def _with_interval(title: str, name: str, digits: int) -> Shown:
    def cell(row: dict[str, Any]) -> str:
        ends = interval(row[f"{name}_low"], row[f"{name}_high"], digits)
        value = number(row[name], digits)
        return f"{value} ({ends})" if ends != number(float("nan")) else value

    return Shown(title, cell)


_NAME = Shown("name", lambda r: r["name"], words=True)
_PAIR = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("reference", lambda r: r["reference"], words=True),
]
_TEST = [
    Shown("pairs", lambda r: count(r["n_pairs"])),
    Shown("missing", lambda r: count(r["n_missing"])),
    Shown("T+", lambda r: number(r["wilcoxon_statistic"])),
    Shown("p", lambda r: p_value(r["wilcoxon_p"])),
]
_HOLM = Shown("p (Holm)", lambda r: p_value(r["wilcoxon_p_holm"]))
_EFFECTS = [
    _with_interval("mean difference", "mean_difference", 1),
    _with_interval("rank-biserial", "rank_biserial", 2),
    _with_interval("d_z", "d_z", 2),
]
_TOST = Shown("p (TOST)", lambda r: p_value(r["tost_p"]))
_KS = [
    Shown("D", lambda r: number(r["ks_d"], 2)),
    Shown("p (KS)", lambda r: p_value(r["ks_p"])),
]
