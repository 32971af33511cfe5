"""Groups of participants compared."""

import math
from collections.abc import Sequence

import pandas as pd

from analysis.figures.flow_diagram import flow_figure
from analysis.report.blocks import Block, Paragraph, Picture, Remarks, Section, Shown, table
from analysis.report.numbers import count, interval, number, p_value
from analysis.results import StudyResults
from analysis.stats.result import TestResult


def group_section(results: StudyResults) -> Section | None:
    """Return flow and comparisons of the groups; None for a study without groups."""
    groups = results.groups
    if groups is None:
        return None
    blocks: list[Block] = [
        Paragraph(
            "Groups differ between participants, so each person counts once. Exploratory: the "
            "rank-sum test of people's log lap times, and of their contrasts with the reference "
            "condition (group x condition)."
        ),
        _picture(groups.flow),
        table("groups_flow", "Participants by group.", groups.flow, _FLOW),
    ]
    frame = _frame(groups.tests, groups.p_holm)
    if len(frame):
        caption = "Ratios of lap times between groups, with 95% intervals; Holm over this table."
        blocks.append(table("groups", caption, frame, [*_RATIO, _HOLM]))
    if groups.models:
        frame = _frame(groups.models, [math.nan] * len(groups.models))
        caption = "The same in a mixed model, on Kenward and Roger's degrees of freedom."
        blocks.append(table("groups_model", caption, frame, _RATIO))
        methods = dict.fromkeys(found.method for found in groups.models)
        blocks.append(Remarks(tuple(f"{m[0].upper()}{m[1:]}." for m in methods)))
    return Section("groups", "Groups", tuple(blocks))


def _picture(flow: pd.DataFrame) -> Picture:
    said = [
        f"{row.group}: {row.recorded} recorded, {row.refused} refused consent, "
        f"{row.excluded} excluded, {row.analysed} analysed"
        for row in flow.itertuples()
    ]
    return Picture(
        name="groups_flow_diagram",
        caption="Participants of each group, from allocation to analysis.",
        alternative=f"{'. '.join(said)}.",
        figure=flow_figure(flow),
    )


def _frame(found: Sequence[TestResult], p_holm: Sequence[float]) -> pd.DataFrame:
    return pd.DataFrame(
        [
            {
                "contrast": t.name,
                "n": t.n,
                "ratio": math.exp(t.estimate),
                "ratio_low": math.exp(t.low),
                "ratio_high": math.exp(t.high),
                "p": t.p,
                "p_holm": p,
            }
            for t, p in zip(found, p_holm, strict=True)
        ]
    )


_FLOW = [
    Shown("group", lambda r: r["group"], words=True),
    *(
        Shown(name, lambda r, name=name: count(r[name]))  # type: ignore[misc]
        for name in ("recorded", "refused", "excluded", "analysed")
    ),
    Shown("excluded because", lambda r: r["reasons"], words=True),
]
_RATIO = [
    Shown("contrast", lambda r: r["contrast"], words=True),
    Shown("participants", lambda r: count(r["n"])),
    Shown("ratio", lambda r: number(r["ratio"], 3)),
    Shown("95%", lambda r: interval(r["ratio_low"], r["ratio_high"], 3)),
    Shown("p", lambda r: p_value(r["p"])),
]
_HOLM = Shown("p (Holm)", lambda r: p_value(r["p_holm"]))
