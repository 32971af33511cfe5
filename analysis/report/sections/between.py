"""Comparisons of groups that the protocol declares: sentences and a table."""

import math
from collections.abc import Sequence
from typing import Any

import pandas as pd

from analysis.attainable import ALPHA
from analysis.group_comparisons import GroupComparison
from analysis.report.blocks import Block, Remarks, Shown, table
from analysis.report.numbers import count, is_p, number, p_value, plural, with_interval


def between_blocks(found: Sequence[GroupComparison]) -> list[Block]:
    """Return the table of the declared comparisons of groups; nothing where there is none."""
    if not found:
        return []
    shown = [table("between", _CAPTION, between_table(found), _COLUMNS)]
    remarks = tuple(f"{c.name}: {_remark(c)}." for c in found if _remark(c))
    return [*shown, Remarks(remarks)] if remarks else list(shown)


def between_table(found: Sequence[GroupComparison]) -> pd.DataFrame:
    """Return one row per comparison, as the CSV has it."""
    return pd.DataFrame([_row(c) for c in found])


def between_sentence(c: GroupComparison) -> str:
    """Return what a comparison of lap times says, for the first screen."""
    start = f"{c.name[0].upper()}{c.name[1:]} ({c.kind}, between groups): "
    if not c.test.computed:
        return f"{start}cannot be computed: {c.test.why_not}."
    p = c.p_holm if math.isfinite(c.p_holm) else c.test.p
    corrected = "after Holm" if math.isfinite(c.p_holm) else "not corrected"
    low, high = _percent(c.test.low), _percent(c.test.high)
    span = f", 95% interval {number(low)} to {number(high)}%" if math.isfinite(low) else ""
    people = " and ".join(
        f"{plural(n, 'participant')} of {name}" for n, name in zip(c.n, c.groups, strict=True)
    )
    missing = f" ({c.missing} missing)" if c.missing else ""
    return (
        f"{start}{_difference(c)} by {number(_percent(c.test.estimate))}%{span}; {people}"
        f"{missing}; rank-sum {is_p(p)} {corrected}. {_verdict(c, p)}"
    )


def _difference(c: GroupComparison) -> str:
    first, second = c.groups
    if c.reference is None:
        return f"lap times in {c.condition} differ, {first} against {second},"
    return (
        f"what {c.condition} does to lap times, against {c.reference}, differs, {first} against "
        f"{second},"
    )


def _percent(log_ratio: float) -> float:
    return 100 * math.expm1(log_ratio)


def _verdict(c: GroupComparison, p: float) -> str:
    if p >= ALPHA:
        if c.smallest_p > ALPHA:
            return (
                "It could not have been significant with so few people: the smallest p that is "
                f"possible is {p_value(c.smallest_p)}."
            )
        return "No difference between the groups is shown; that is not the same as no difference."
    if c.kind != "confirmatory":
        return "The groups tend to differ; the test is exploratory, its p is not corrected."
    return "The groups differ."


_CAPTION = (
    "Comparisons between groups that the protocol declares: the rank-sum test of people's values, "
    "each person once, with the Hodges-Lehmann shift. Of lap times the change in percent; with a "
    "reference, the change of condition / reference (group x condition). Confirmatory p after "
    "Holm within their family. In brackets: 95% intervals."
)


def _row(c: GroupComparison) -> dict[str, object]:
    ends = (c.test.estimate, c.test.low, c.test.high)
    if c.outcome == "lap_time_s":
        ends = (_percent(ends[0]), _percent(ends[1]), _percent(ends[2]))
    return {
        "name": c.name,
        "kind": c.kind,
        "outcome": c.outcome,
        "unit": "%" if c.outcome == "lap_time_s" else c.unit,
        "condition": c.condition,
        "reference": c.reference or "",
        "group": c.groups[0],
        "reference_group": c.groups[1],
        "n": c.n[0],
        "n_reference": c.n[1],
        "n_missing": c.missing,
        "median": c.medians[0],
        "median_reference": c.medians[1],
        **dict(zip(("difference", "difference_low", "difference_high"), ends, strict=True)),
        "u": c.test.statistic,
        "p": c.test.p,
        "p_holm": c.p_holm,
        "smallest_p": c.smallest_p,
    }


def _remark(c: GroupComparison) -> str:
    return "; ".join([c.test.why_not] if c.test.why_not else c.test.notes)


def _condition(row: dict[str, Any]) -> str:
    return f"{row['condition']} − {row['reference']}" if row["reference"] else row["condition"]


def _shift(row: dict[str, Any]) -> str:
    shown = with_interval(row["difference"], row["difference_low"], row["difference_high"], 1)
    return f"{shown} {row['unit']}".rstrip()


_COLUMNS = [
    Shown("comparison", lambda r: f"{r['name']}: {_condition(r)}", words=True),
    Shown("groups", lambda r: f"{r['group']} − {r['reference_group']}", words=True),
    Shown("kind", lambda r: r["kind"], words=True),
    Shown("people", lambda r: f"{count(r['n'])} + {count(r['n_reference'])}"),
    Shown("missing", lambda r: count(r["n_missing"])),
    Shown("difference", _shift),
    Shown("p", lambda r: p_value(r["p"])),
    Shown("p (Holm)", lambda r: p_value(r["p_holm"])),
]
