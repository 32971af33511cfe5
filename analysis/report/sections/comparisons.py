"""Tests between conditions: confirmatory and exploratory, kept apart as the protocol declares."""

import math
from collections.abc import Sequence
from typing import Any

from analysis.comparisons import PairedComparison
from analysis.report.blocks import Block, Paragraph, Remarks, Section, Shown, table
from analysis.report.numbers import (
    NOTHING,
    count,
    interval,
    number,
    p_value,
    rank_sum,
    with_interval,
)
from analysis.report.sections.between import between_blocks
from analysis.results import StudyResults
from analysis.tables.comparisons import comparison_table, sensitivity_table


def comparison_section(results: StudyResults) -> Section:
    """Return what was declared first, then everything that was not."""
    confirmatory = [c for c in results.declared if c.kind == "confirmatory"]
    between = any(c.kind == "confirmatory" for c in results.between)
    declared = [c for c in results.declared if c.kind == "exploratory"]
    others = _undeclared(results)
    blocks: list[Block] = []
    if confirmatory:
        caption = (
            "Confirmatory comparisons, as the protocol declared them before the first lap; p after "
            "Holm's correction within each family, of the test of equivalence (TOST) where a "
            "margin is declared."
        )
        columns = [_NAMED, *_TEST, *_tost(confirmatory), _HOLM]
        blocks += _table("confirmatory", caption, confirmatory, columns)
    elif not between:
        blocks.append(Paragraph("The protocol declares no confirmatory comparison."))
    if declared:
        caption = "Exploratory comparisons that the protocol declares; p not corrected."
        columns = [_NAMED, *_TEST, *_tost(declared)]
        blocks += _table("exploratory", caption, declared, columns)
    blocks += between_blocks(results.between)
    unfinished = sensitivity_table(results.declared)
    if len(unfinished):
        blocks.append(table("unfinished", _ABOUT_UNFINISHED, unfinished, _UNFINISHED))
    if results.without_rule:
        frame = comparison_table(results.without_rule)
        blocks.append(table("without_exclusion", _ABOUT_RULE, frame, [_NAMED, *_TEST, _HOLM]))
    if others:
        caption = (
            "Exploratory: lap times of the pairs of conditions that the protocol does not declare; "
            "p not corrected. Differences in seconds, condition minus reference."
        )
        blocks += _table("lap_time_comparisons", caption, others, [_PAIR, *_TEST])
    if results.lap_times:
        frame = comparison_table(results.lap_times)[["condition", "reference", "ks_d", "ks_p"]]
        blocks.append(table("kolmogorov_smirnov", _ABOUT_KS, frame, [_PAIR, *_KS]))
    return Section("comparisons", "Comparisons", tuple(blocks))


def _undeclared(results: StudyResults) -> list[PairedComparison]:
    """Return the pairs without a table of their own, where their p may be corrected."""
    declared = {
        frozenset((c.condition, c.reference)) for c in results.declared if c.outcome == "lap_time_s"
    }
    pairs = ((frozenset((c.condition, c.reference)), c) for c in results.lap_times)
    return [c for pair, c in pairs if pair not in declared]


def _tost(comparisons: Sequence[PairedComparison]) -> list[Shown]:
    """Return the columns of the test of equivalence where a comparison asks for it."""
    return _TOST if any(c.equivalence is not None for c in comparisons) else []


_ABOUT_UNFINISHED = (
    "Lap times with unfinished laps counted in three ways. Complete pairs: a pair without both "
    "times is left out. Limit: a lap that ran into its time limit took that long. Worst rank: it "
    "is slower than every finished lap. p not corrected."
)

_ABOUT_RULE = (
    "The declared comparisons without the rule on completed laps: nobody is left out for it. It "
    "looks at the outcome: who does not finish is slow. Where the two tables differ, it is the "
    "rule that makes the difference."
)

_ABOUT_KS = (
    "Kolmogorov-Smirnov, lap times of every two conditions. It compares whole distributions and "
    "assumes two separate groups. Here both samples come from the same "
    "people, so D and its p only describe."
)


def _table(
    name: str, caption: str, comparisons: Sequence[PairedComparison], columns: list[Shown]
) -> list[Block]:
    """Return tests and effect sizes of some comparisons, and remarks where there are any."""
    frame = comparison_table(comparisons)
    remarks = tuple(f"{r['name']}: {r['notes']}." for r in frame.to_dict("records") if r["notes"])
    found = table(name, f"{caption} In brackets: 95% intervals.", frame, [*columns, *_EFFECTS])
    return [found, Remarks(remarks)] if remarks else [found]


def _with_interval(title: str, name: str, digits: int) -> Shown:
    def cell(row: dict[str, Any]) -> str:
        shown = with_interval(row[name], row[f"{name}_low"], row[f"{name}_high"], digits)
        return shown.replace(" [", "\n[")  # below it: four intervals beside each other are wide

    return Shown(title, cell)


def _pair(row: dict[str, Any]) -> str:
    return f"{row['condition']} − {row['reference']}"


_NAMED = Shown("condition − reference", lambda r: f"{r['name']}: {_pair(r)}", words=True)
_PAIR = Shown("condition − reference", _pair, words=True)
_TEST = [
    Shown("pairs", lambda r: count(r["n_pairs"])),
    Shown("missing", lambda r: count(r["n_missing"])),
    Shown("practice", lambda r: r["practice"] or NOTHING, words=True),
    _with_interval("change / %", "change_percent", 1),
    Shown("p", lambda r: p_value(r["p"])),
]
_HOLM = Shown("p (Holm)", lambda r: p_value(r["p_holm"]))
_UNFINISHED = [
    _NAMED,
    Shown("unfinished laps", lambda r: r["unfinished"], words=True),
    Shown("declared", lambda r: "yes" if r["declared"] else "", words=True),
    Shown("pairs", lambda r: count(r["n"])),
    _with_interval("change / %", "change_percent", 1),
    Shown("p", lambda r: p_value(r["p"])),
]
_EFFECTS = [
    Shown("T+", lambda r: rank_sum(r["wilcoxon_statistic"])),
    Shown("p, differences", lambda r: p_value(r["wilcoxon_p"])),
    _with_interval("mean difference", "mean_difference", 1),
    _with_interval("pseudomedian", "pseudomedian", 1),
    _with_interval("rank-biserial", "rank_biserial", 2),
    _with_interval("d_z", "d_z", 2),
]
_TOST = [
    Shown("margin", lambda r: "–" if math.isnan(r["margin"]) else f"±{r['margin']:g} {r['unit']}"),
    Shown("90%", lambda r: interval(r["tost_low"], r["tost_high"])),
    Shown("p (TOST)", lambda r: p_value(r["tost_p"])),
]
_KS = [
    Shown("D", lambda r: number(r["ks_d"], 2)),
    Shown("p (KS)", lambda r: p_value(r["ks_p"])),
]
