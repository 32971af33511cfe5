"""Tests between conditions: confirmatory and exploratory, kept apart as the protocol declares."""

from typing import Any

from analysis.comparisons import PairedComparison
from analysis.report.blocks import Block, Paragraph, Section, Shown, table
from analysis.report.words import NOTHING, count, interval, number, p_value
from analysis.results import StudyResults
from analysis.tables.comparisons import comparison_table


def comparison_section(results: StudyResults) -> Section:
    """Return what was declared first, then everything that was not."""
    confirmatory = [c for c in results.declared if c.kind == "confirmatory"]
    declared = [c for c in results.declared if c.kind == "exploratory"]
    blocks: list[Block] = []
    if confirmatory:
        blocks.append(
            table("confirmatory", "Confirmatory comparisons, as the protocol declared them before "
                  "the first lap; p after Holm's correction within each family.",
                  comparison_table(confirmatory), [*_START, _HOLM, *_EFFECTS])
        )  # fmt: skip
    else:
        blocks.append(Paragraph("The protocol declares no confirmatory comparison."))
    if declared:
        blocks.append(
            table("exploratory", "Exploratory comparisons that the protocol declares; p not "
                  "corrected.", comparison_table(declared), [*_START, *_EFFECTS, *_TOST])
        )  # fmt: skip
    blocks += _all_lap_times(results.lap_times)
    return Section("comparisons", "Comparisons", tuple(blocks))


def _all_lap_times(comparisons: tuple[PairedComparison, ...]) -> list[Block]:
    if not comparisons:
        return []
    return [
        table("lap_time_comparisons", "Exploratory: lap times of every two conditions; p not "
              "corrected. Differences in seconds, condition minus reference.",
              comparison_table(comparisons), [*_START[1:], *_EFFECTS, *_KS]),
        Paragraph(
            "Kolmogorov-Smirnov compares whole distributions and assumes two separate groups; the "
            "paper used it on laps of the autonomous driver. Here both samples come from the same "
            "people, so D and its p only describe."
        ),
    ]  # fmt: skip


def _with_interval(name: str, digits: int) -> list[Shown]:
    def cell(row: dict[str, Any]) -> str:
        return number(row[name], digits)

    def ends(row: dict[str, Any]) -> str:
        return interval(row[f"{name}_low"], row[f"{name}_high"], digits)

    titles = {"mean_difference": "mean difference", "rank_biserial": "rank-biserial", "d_z": "d_z"}
    return [Shown(titles[name], cell), Shown("95%", ends)]


_START = [
    Shown("name", lambda r: r["name"], words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("reference", lambda r: r["reference"], words=True),
    Shown("outcome", lambda r: r["outcome"], words=True),
    Shown("pairs", lambda r: count(r["n_pairs"])),
    Shown("missing", lambda r: count(r["n_missing"])),
    Shown("Wilcoxon T+", lambda r: number(r["wilcoxon_statistic"])),
    Shown("p", lambda r: p_value(r["wilcoxon_p"])),
]
_HOLM = Shown("p (Holm)", lambda r: p_value(r["wilcoxon_p_holm"]))
_EFFECTS = [
    *_with_interval("mean_difference", 1),
    *_with_interval("rank_biserial", 2),
    *_with_interval("d_z", 2),
    Shown("remarks", lambda r: r["notes"] or NOTHING, words=True),
]
_TOST = [Shown("TOST p", lambda r: p_value(r["tost_p"]))]
_KS = [
    Shown("KS D", lambda r: number(r["ks_d"], 3)),
    Shown("KS p", lambda r: p_value(r["ks_p"])),
]
